// runtime/scene/tessellate/quadric.cpp: quadrics as profiles that turn about z.
//
// RISpec 3.2, section 5.2 (Quadrics), with the slips in its printed formulas corrected.
#include <array>
#include <cmath>
#include <numbers>

#include "runtime/scene/tessellate/sheet_p.h"

namespace kinora::tessellation {

namespace {

// A place of the profile, before it turns, and its derivatives by t.
struct ProfileJet {
    dvec3 p{0.0}, d{0.0}, dd{0.0};
};

struct Profile {
    ProfileJet (*at)(const Profile& profile, double t) = nullptr;
    dvec3 from{0.0}, to{0.0};     // line
    double ring = 0, radius = 0;  // arc: where its centre turns
    double start = 0, end = 0;    // arc, degrees; paraboloid: radii
    double height = 0;            // paraboloid: at `radius`
    double bow = 1;
};

struct Turn {
    double cos, sin;
};

// Exact at quarters of a circle, so that full sweeps close and poles are points.
Turn turn(double degrees) {
    double quarters = std::nearbyint(degrees / 90);
    double rest = radians(degrees - 90 * quarters);
    double c = std::cos(rest), s = std::sin(rest);
    const Turn turns[4] = {{c, s}, {-s, c}, {-c, -s}, {s, -c}};
    return turns[size_t(std::fmod(std::fmod(quarters, 4) + 4, 4))];
}

ProfileJet line_at(const Profile& p, double t) {
    return {(1 - t) * p.from + t * p.to, p.to - p.from, dvec3(0.0)};
}

ProfileJet arc_at(const Profile& p, double t) {
    Turn a = turn((1 - t) * p.start + t * p.end);
    double rate = radians(p.end - p.start), r = p.radius;
    return {{p.ring + r * a.cos, 0, r * a.sin},
            {-r * rate * a.sin, 0, r * rate * a.cos},
            {-r * rate * rate * a.cos, 0, -r * rate * rate * a.sin}};
}

// z = zmax (r / rmax)^2, with r in proportion to t.
ProfileJet parabola_at(const Profile& p, double t) {
    double r = (1 - t) * p.start + t * p.end, rate = p.end - p.start;
    double k = p.height / (p.radius * p.radius);
    return {{r, 0, k * r * r}, {rate, 0, 2 * k * r * rate}, {0, 0, 2 * k * rate * rate}};
}

Profile line(dvec3 from, dvec3 to) {
    Profile result;
    result.at = line_at;
    result.from = from;
    result.to = to;
    return result;
}

Profile arc(double ring, double radius, double start, double end) {
    Profile result;
    result.at = radius != 0 && start != end ? arc_at : nullptr;
    result.ring = ring;
    result.radius = radius;
    result.start = start;
    result.end = end;
    return result;
}

double degrees_at_height(double z, double radius) {
    double sine = z / radius;
    if (sine <= -1) return -90;
    if (sine >= 1) return 90;
    return std::asin(sine) * (180 / kPi);
}

Profile sphere(const double* n) {
    return arc(0, n[0], degrees_at_height(n[1], n[0]), degrees_at_height(n[2], n[0]));
}
Profile cone(const double* n) {
    return line({n[1], 0, 0}, {0, 0, n[0]});
}
Profile cylinder(const double* n) {
    return line({n[0], 0, n[1]}, {n[0], 0, n[2]});
}
Profile hyperboloid(const double* n) {
    return line({n[0], n[1], n[2]}, {n[3], n[4], n[5]});
}
Profile paraboloid(const double* n) {
    Profile result;
    result.radius = n[0];
    result.height = n[2];
    double first = n[1] / n[2];  // of the height
    if (!(first < 1) || n[0] == 0) return result;
    result.bow = std::sqrt(std::max(0.0, first));
    result.start = n[0] * result.bow;
    result.end = n[0];
    result.at = parabola_at;
    return result;
}
Profile disk(const double* n) {
    return line({n[1], 0, n[0]}, {0, 0, n[0]});
}
Profile torus(const double* n) {
    return arc(n[0], n[1], n[2], n[3]);
}

struct QuadricRow {
    Profile (*profile)(const double* numbers);
    int sweep;  // which number it is
};

// In the order of CurvedKind.
constexpr QuadricRow kQuadrics[] = {
    {sphere, 3}, {cone, 2}, {cylinder, 3}, {hyperboloid, 6}, {paraboloid, 3}, {disk, 2}, {torus, 4},
};
static_assert(std::size(kQuadrics) == size_t(CurvedKind::Torus) + 1);

constexpr uint32_t kLattice = 9;  // samples of a sweep

dvec3 turned(Turn a, dvec3 p) {
    return {a.cos * p.x - a.sin * p.y, a.sin * p.x + a.cos * p.y, p.z};
}

class Quadric : public Sheet {
  public:
    Quadric(const Profile& profile, double sweep) : profile_(profile), sweep_(sweep) {
        u.lattice = v.lattice = kLattice;
        v.bow = profile.bow;
    }

    void sample(std::span<const Line> lines_u, std::span<const Line> lines_v, bool,
                JetSink sink) const override {
        std::vector<Turn> turns(lines_u.size());
        for (size_t i = 0; i < turns.size(); ++i) turns[i] = turn(lines_u[i].t * sweep_);
        const double rate = radians(sweep_);
        size_t sample = 0;
        for (const Line& line : lines_v) {
            ProfileJet q = profile_.at(profile_, line.t);
            // The derivative of a turn is a quarter turn more, without z.
            dvec3 p_side = rate * dvec3(-q.p.y, q.p.x, 0), d_side = rate * dvec3(-q.d.y, q.d.x, 0);
            dvec3 inwards = -rate * rate * dvec3(q.p.x, q.p.y, 0);
            for (Turn a : turns)
                sink(sample++, {turned(a, q.p), turned(a, p_side), turned(a, q.d),
                                turned(a, inwards), turned(a, d_side), turned(a, q.dd)});
        }
    }

    // Four corners are all that quadrics have.
    std::vector<float> blend(std::span<const float> values, uint32_t components,
                             std::span<const Line> lines_u,
                             std::span<const Line> lines_v) const override {
        std::vector<float> result;
        result.reserve(lines_u.size() * lines_v.size() * components);
        for (const Line& b : lines_v)
            for (const Line& a : lines_u)
                for (uint32_t c = 0; c < components; ++c)
                    result.push_back(float(bilinear<double>(
                        values[c], values[components + c], values[2 * components + c],
                        values[3 * components + c], u.part(a.t), v.part(b.t))));
        return result;
    }

  private:
    Profile profile_;
    double sweep_;
};

}  // namespace

std::unique_ptr<Sheet> make_quadric(const CurvedSurface& surface) {
    for (double number : surface.numbers)
        if (!std::isfinite(number)) return nullptr;
    const QuadricRow& row = kQuadrics[size_t(surface.kind)];
    Profile profile = row.profile(surface.numbers);
    double sweep = surface.numbers[row.sweep];
    if (!profile.at || sweep == 0) return nullptr;
    return std::make_unique<Quadric>(profile, sweep);
}

std::unique_ptr<Sheet> make_sheet(const CurvedSurface& surface) {
    return is_quadric(surface.kind) ? make_quadric(surface) : make_net(surface);
}

}  // namespace kinora::tessellation
