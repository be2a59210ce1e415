// runtime/scene/tessellate/subdivide.cpp: as many steps as the picture needs, and their triangles.
#include "runtime/scene/tessellate/subdivide.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/tessellate/cage_p.h"
#include "runtime/scene/tessellate/fineness_p.h"

namespace kinora {

namespace tessellation {

namespace {

constexpr int kMostSteps = 6;
constexpr double kErrorOfNext = 1 / 3.5;  // of the error before: a quarter, where it is smooth
constexpr uint32_t kMostVariableComponents = 64;

bool per_corner(VariableRate rate) {
    return rate == VariableRate::Varying || rate == VariableRate::FaceVarying;
}

size_t value_count(const SubdivisionSurface& surface, VariableRate rate) {
    const size_t points = surface.points.size();
    const size_t counts[] = {1, surface.face_sizes.size(), points, points, surface.indices.size()};
    return counts[size_t(rate)];
}

bool is_sound(const SubdivisionSurface& surface, const SurfaceVariable& v) {
    return v.components > 0 && v.components <= kMostVariableComponents &&
           v.values.size() / v.components >= value_count(surface, v.rate);
}

double extent(const Cage& cage) {
    dvec3 low(1e300), high(-1e300);
    for (size_t p = 0; p < cage.points(); ++p) {
        const dvec3 at = cage.place(p);
        if (!is_finite(at)) continue;
        low = glm::min(low, at);
        high = glm::max(high, at);
    }
    const dvec3 size = glm::max(high - low, dvec3(0.0));
    return std::max({size.x, size.y, size.z});
}

dvec3 limit_place(const CageLimit& limit, uint32_t stride, size_t point) {
    const double* p = &limit.values[point * stride];
    return {p[0], p[1], p[2]};
}

// Pixels between the triangles of a cage and where the middles of their edges end; `next` is the
// next step's limit.
double step_error(const Cage& cage, const CageLimit& limit, const CageLimit& next,
                  const PixelMeasure& measure) {
    const size_t centres = cage.points(), middles = centres + cage.quads.size();
    auto place = [&](size_t point) { return limit_place(limit, cage.stride, point); };
    auto off = [&](size_t reached, uint32_t a, uint32_t b) {
        const dvec3 p = limit_place(next, cage.stride, reached);
        const dvec3 edge = measure.vector(place(b) - place(a));
        const dvec3 to = measure.vector(p - 0.5 * (place(a) + place(b)));
        const double square = glm::dot(edge, edge);
        const dvec3 along = square > 0 ? glm::dot(to, edge) / square * edge : dvec3(0.0);
        const double length = std::max(glm::length(to - along), glm::length(along) / kSlide);
        const double pixels = measure.at(measure.place(p)) * length;
        return std::isfinite(pixels) ? pixels : 0;
    };
    double most = 0;
    for (size_t e = 0; e < cage.edges.size(); ++e)
        most = std::max(most, off(middles + e, cage.edges[e].from, cage.edges[e].to));
    for (size_t q = 0; q < cage.quads.size(); ++q) {
        const auto& quad = cage.quads[q];
        most = std::max(
            most, std::min(off(centres + q, quad[0], quad[2]), off(centres + q, quad[1], quad[3])));
    }
    return most;
}

// Steps until the error is small enough, or the next would be over the limits.
Cage refined(Cage cage, const PixelMeasure& measure, const TessellationLimits& limits,
             double& error) {
    const double most = limits.error > 0 ? limits.error : 0.25;
    error = 0;
    for (int step = 0; step < kMostSteps && !cage.quads.empty(); ++step) {
        const bool last = 8 * cage.quads.size() > limits.triangles;
        if (last && step > 0) break;
        Cage next = refine(cage);
        error = step_error(cage, limit_of(cage, false), limit_of(next, false), measure);
        if (error <= most || last) break;
        next.roots = std::move(cage.roots);
        cage = std::move(next);
        error *= kErrorOfNext;
        if (error <= most) break;
    }
    return cage;
}

// The corners of triangles, as quads' corners: 4 x quad + corner.
std::vector<uint32_t> triangle_corners(const Cage& cage, const CageLimit& limit, bool reversed) {
    std::vector<uint32_t> corners;
    for (uint32_t q = 0; q < cage.quads.size(); ++q) {
        if (!cage.roots[cage.places[q].root].drawn) continue;
        dvec3 p[4];
        for (size_t k = 0; k < 4; ++k) p[k] = limit_place(limit, cage.stride, cage.quads[q][k]);
        const dvec3 up = p[2] - p[0], down = p[3] - p[1];
        if (!is_finite(up) || !is_finite(down)) continue;
        constexpr uint32_t kShort[2][6] = {{0, 1, 2, 0, 2, 3}, {0, 1, 3, 1, 2, 3}};
        const uint32_t* order = kShort[glm::dot(down, down) < glm::dot(up, up)];
        for (int t = 0; t < 6; t += 3) {
            const dvec3 side =
                glm::cross(p[order[t + 1]] - p[order[t]], p[order[t + 2]] - p[order[t]]);
            if (!(glm::dot(side, side) > 0)) continue;
            for (int k : {0, reversed ? 2 : 1, reversed ? 1 : 2})
                corners.push_back(4 * q + order[t + k]);
        }
    }
    return corners;
}

// What entries are numbered by, in the order in which triangles come to them.
class Numbers {
  public:
    explicit Numbers(size_t count) : number_(count, kNone) {}
    // Whether it is new.
    bool add(size_t key) {
        const bool made = number_[key] == kNone;
        if (made) number_[key] = count_++;
        return made;
    }
    uint32_t operator[](size_t key) const { return number_[key]; }

  private:
    std::vector<uint32_t> number_;
    uint32_t count_ = 0;
};

class CageAttributes {
  public:
    CageAttributes(const SubdivisionSurface& surface, const Cage& cage, const CageLimit& limit,
                   const std::vector<uint32_t>& corners)
        : surface_(surface), cage_(cage), limit_(limit), corners_(corners) {}

    std::vector<VertexAttribute> make(const std::vector<const SurfaceVariable*>& vertex_variables) {
        result_.push_back(normals());
        result_.push_back(texture_coordinates(vertex_variables));
        result_.push_back(by_corner(kSurfaceParameters, 2, [&](uint32_t corner, float* to) {
            const dvec2 at = parameters(corner);
            to[0] = float(at.x), to[1] = float(at.y);
        }));
        for (const SurfaceVariable& v : surface_.variables) {
            const bool taken = v.name == "st" || v.name == "N" ||
                               ((v.name == "s" || v.name == "t") && !named("st", 2));
            if (!taken && is_sound(surface_, v)) result_.push_back(variable(v, vertex_variables));
        }
        return std::move(result_);
    }

  private:
    const SurfaceVariable* named(std::string_view name, uint32_t components) const {
        for (const SurfaceVariable& v : surface_.variables)
            if (v.name == name && v.components == components && is_sound(surface_, v)) return &v;
        return nullptr;
    }
    uint32_t point(uint32_t corner) const { return cage_.quads[corner / 4][corner % 4]; }
    const RootQuad& root(uint32_t corner) const {
        return cage_.roots[cage_.places[corner / 4].root];
    }
    dvec2 parameters(uint32_t corner) const {
        const QuadPlace& place = cage_.places[corner / 4];
        const uint32_t k = corner % 4;
        return {place.u + (k == 1 || k == 2) * place.size, place.v + (k >= 2) * place.size};
    }

    template <class Fill>
    VertexAttribute by_corner(std::string name, uint32_t stride, Fill fill) const {
        return by_key(
            std::move(name), stride, 4 * cage_.quads.size(), [](uint32_t corner) { return corner; },
            fill);
    }
    template <class Fill>
    VertexAttribute by_point(std::string name, uint32_t stride, Fill fill) const {
        return by_key(
            std::move(name), stride, cage_.points(), [&](uint32_t corner) { return point(corner); },
            fill);
    }
    template <class Key, class Fill>
    VertexAttribute by_key(std::string name, uint32_t stride, size_t keys, Key key,
                           Fill fill) const {
        VertexAttribute a{std::move(name), 0, stride, {}, {}};
        Numbers numbers(keys);
        for (uint32_t corner : corners_) {
            if (numbers.add(key(corner))) {
                a.values.resize(a.values.size() + stride);
                fill(corner, &a.values[a.values.size() - stride]);
            }
            a.corners.push_back(numbers[key(corner)]);
        }
        return a;
    }

    VertexAttribute normals() const {
        if (const SurfaceVariable* given = named("N", 3)) return given_normals(*given);
        const double side = surface_.reversed ? -1 : 1;
        return by_point("NORMAL", 3, [&](uint32_t corner, float* to) {
            dvec3 n = limit_.normals[point(corner)];
            if (n == dvec3(0.0)) n = {0, 0, 1};
            for (int c = 0; c < 3; ++c) to[c] = float(side * n[c]);
        });
    }

    VertexAttribute given_normals(const SurfaceVariable& given) const {
        const double side = surface_.reversed ? -1 : 1;
        return by_corner("NORMAL", 3, [&](uint32_t corner, float* to) {
            value(given, corner, to);
            dvec3 n(to[0], to[1], to[2]);
            const double length = glm::length(n);
            n = length > 0 && std::isfinite(length) ? n / length
                                                    : side * limit_.normals[point(corner)];
            if (n == dvec3(0.0)) n = {0, 0, 1};
            for (int c = 0; c < 3; ++c) to[c] = float(n[c]);
        });
    }

    // Vertex variables count as varying here: normals and single coordinates alone come this way.
    void value(const SurfaceVariable& v, uint32_t corner, float* to) const {
        const RootQuad& quad = root(corner);
        const uint32_t c = v.components;
        auto at = [&](uint32_t k, uint32_t i) -> double {
            const uint32_t index = quad.first + k % quad.size;
            const size_t entry = v.rate == VariableRate::Constant      ? 0
                                 : v.rate == VariableRate::Uniform     ? quad.face
                                 : v.rate == VariableRate::FaceVarying ? index
                                                                       : surface_.indices[index];
            return v.values[entry * c + i];
        };
        const dvec2 uv = parameters(corner);
        for (uint32_t i = 0; i < c; ++i) {
            double p[4];
            if (quad.size == 4) {
                for (uint32_t k = 0; k < 4; ++k) p[k] = at(k, i);
            } else {
                const double own = at(quad.corner, i);
                p[0] = own;
                p[1] = 0.5 * (own + at(quad.corner + 1, i));
                p[3] = 0.5 * (own + at(quad.corner + quad.size - 1, i));
                p[2] = mean(quad, v, i, at);
            }
            to[i] = float(bilinear(p[0], p[1], p[3], p[2], uv.x, uv.y));
        }
    }
    // Kept for the face: a quad is there for each of its corners.
    template <class At>
    double mean(const RootQuad& quad, const SurfaceVariable& v, uint32_t component, At at) const {
        if (mean_of_ != &v || mean_face_ != quad.face) {
            mean_of_ = &v;
            mean_face_ = quad.face;
            means_.assign(v.components, 0.0);
            for (uint32_t k = 0; k < quad.size; ++k)
                for (uint32_t i = 0; i < v.components; ++i) means_[i] += at(k, i) / quad.size;
        }
        return means_[component];
    }

    VertexAttribute texture_coordinates(const std::vector<const SurfaceVariable*>& vertex) const {
        if (const SurfaceVariable* st = named("st", 2)) {
            VertexAttribute a = variable(*st, vertex);
            a.semantic = "TEXCOORD";
            return a;
        }
        const SurfaceVariable *s = named("s", 1), *t = named("t", 1);
        return by_corner("TEXCOORD", 2, [&](uint32_t corner, float* to) {
            const dvec2 at = parameters(corner);
            to[0] = float(at.x), to[1] = float(at.y);
            if (s) value(*s, corner, to);
            if (t) value(*t, corner, to + 1);
        });
    }

    VertexAttribute variable(const SurfaceVariable& v,
                             const std::vector<const SurfaceVariable*>& vertex) const {
        if (per_corner(v.rate))
            return by_corner(v.name, v.components,
                             [&](uint32_t corner, float* to) { value(v, corner, to); });
        if (v.rate == VariableRate::Vertex) {
            uint32_t offset = 3;
            for (const SurfaceVariable* before : vertex) {
                if (before == &v) break;
                offset += before->components;
            }
            return by_point(v.name, v.components, [&, offset](uint32_t corner, float* to) {
                const double* from = &limit_.values[size_t(point(corner)) * cage_.stride + offset];
                std::transform(from, from + v.components, to, [](double x) { return float(x); });
            });
        }
        const bool constant = v.rate == VariableRate::Constant;
        VertexAttribute a{v.name, 0, v.components, {}, {}};
        const size_t count = value_count(surface_, v.rate) * v.components;
        a.values.assign(v.values.begin(), v.values.begin() + ptrdiff_t(count));
        for (uint32_t corner : corners_) a.corners.push_back(constant ? 0 : root(corner).face);
        return a;
    }

    const SubdivisionSurface& surface_;
    const Cage& cage_;
    const CageLimit& limit_;
    const std::vector<uint32_t>& corners_;
    std::vector<VertexAttribute> result_;
    mutable const SurfaceVariable* mean_of_ = nullptr;
    mutable uint32_t mean_face_ = kNone;
    mutable std::vector<double> means_;
};

}  // namespace

}  // namespace tessellation

Tessellation subdivide(const SubdivisionSurface& surface, const PictureScale& scale,
                       const TessellationLimits& limits) {
    using namespace tessellation;
    std::vector<const SurfaceVariable*> vertex_variables;
    for (const SurfaceVariable& v : surface.variables)
        if (v.rate == VariableRate::Vertex && is_sound(surface, v)) vertex_variables.push_back(&v);
    Tessellation result;
    Cage cage = make_cage(surface, vertex_variables);
    const PixelMeasure measure(scale, [&] { return extent(cage); });
    cage = refined(std::move(cage), measure, limits, result.error);
    const CageLimit limit = limit_of(cage, true);
    const std::vector<uint32_t> corners = triangle_corners(cage, limit, surface.reversed);
    if (corners.empty()) return {};
    Numbers numbers(cage.points());
    for (uint32_t corner : corners) {
        const uint32_t point = cage.quads[corner / 4][corner % 4];
        if (numbers.add(point)) result.positions.push_back(limit_place(limit, cage.stride, point));
        result.group.triangles.push_back(numbers[point]);
    }
    result.group.attributes = CageAttributes(surface, cage, limit, corners).make(vertex_variables);
    return result;
}

}  // namespace kinora
