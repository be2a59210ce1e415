// tests/runtime/scene/tessellate/hostile_test.cpp: surfaces of random and of senseless numbers.
#include <chrono>
#include <limits>
#include <random>

#include "tests/runtime/scene/tessellate/surfaces.h"

namespace kinora {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kOdd[] = {0,    -0.0, 1,         -1,         1e-300, 1e300, -1e300,      360,
                           1e-9, 1e9,  kInfinity, -kInfinity, 3,      -90,   1e308 * 1.7, 5e-324};

class Chance {
  public:
    explicit Chance(unsigned seed) : random_(seed) {}
    uint32_t below(uint32_t n) { return uint32_t(random_() % n); }
    bool one_of(uint32_t n) { return below(n) == 0; }
    double number() {
        if (one_of(40)) return std::nan("");
        if (one_of(4)) return kOdd[below(std::size(kOdd))];
        return std::uniform_real_distribution<double>(-3, 3)(random_);
    }
    double sound() { return std::uniform_real_distribution<double>(-1, 1)(random_); }

  private:
    std::mt19937 random_;
};

PatchDirection direction(Chance& chance) {
    const BasisRows* rows[] = {&kBezier, &kBspline, &kCatmullRom, &kHermite, &kPower};
    PatchDirection d =
        cubic(chance.below(14), *rows[chance.below(5)], chance.below(5), chance.one_of(3));
    if (chance.one_of(10)) d.basis[2][1] = chance.number();
    if (chance.one_of(30)) d.step = ~0u;
    if (chance.one_of(30)) d.points = ~0u - chance.below(5);
    d.order = chance.below(8);
    if (chance.one_of(30)) d.order = ~0u;
    double knot = 0;
    for (uint32_t k = 0; k < d.points % 64 + d.order % 64; ++k) {
        d.knots.push_back(chance.one_of(100) ? chance.number() : knot);
        knot += chance.one_of(2) ? 0 : std::abs(chance.sound());
    }
    if (chance.one_of(20) && !d.knots.empty()) d.knots.pop_back();
    d.low = chance.one_of(10) ? chance.number() : 0.2;
    d.high = chance.one_of(10) ? chance.number() : knot;
    return d;
}

CurvedSurface surface(Chance& chance) {
    CurvedSurface s;
    s.kind = CurvedKind(chance.below(uint32_t(CurvedKind::Nurbs) + 1));
    for (double& number : s.numbers) number = chance.number();
    s.u = direction(chance);
    s.v = direction(chance);
    const bool sound = chance.one_of(2);
    size_t count = (s.u.points % 64) * (s.v.points % 64);
    if (chance.one_of(20) && count > 0) --count;
    for (size_t k = 0; k < count; ++k) {
        auto value = [&] { return sound ? chance.sound() : chance.number(); };
        double x = value(), y = value(), z = value();
        s.points.push_back({x, y, z, value()});
    }
    s.rational = chance.one_of(2);
    s.reversed = chance.one_of(2);
    for (uint32_t k = chance.below(4); k > 0; --k) {
        TrimLoop loop;
        for (uint32_t p = chance.below(30); p > 0; --p) {
            double x = chance.number();
            loop.push_back({x, chance.number()});
        }
        s.trims.push_back(loop);
    }
    const char* names[] = {"N", "st", "s", "t", "Cs", ""};
    for (uint32_t k = chance.below(5); k > 0; --k) {
        SurfaceVariable v;
        v.name = names[chance.below(6)];
        v.rate = VariableRate(chance.below(uint32_t(VariableRate::Vertex) + 1));
        v.components = chance.one_of(20) ? ~0u : chance.below(5);
        v.values.resize(chance.below(300), float(chance.number()));
        s.variables.push_back(v);
    }
    return s;
}

TEST(Hostile, RandomSurfacesEndSoonAndSound) {
    TessellationLimits limits;
    limits.triangles = 2000;
    size_t drawn = 0;
    for (unsigned seed = 0; seed < 4000; ++seed) {
        SCOPED_TRACE(seed);
        Chance chance(seed);
        CurvedSurface s = surface(chance);
        PictureScale scale;
        scale.pixels = chance.number();
        scale.orthographic = chance.one_of(2);
        scale.near = chance.number();
        if (chance.one_of(2)) scale.to_camera[3] = {0, 0, 5, 1};
        if (chance.one_of(5)) scale.to_camera[int(chance.below(4))][1] = chance.number();
        Tessellation t = tessellate(s, scale, limits);
        ASSERT_LE(triangle_count(t), limits.triangles);
        ASSERT_NO_FATAL_FAILURE(expect_sound(t));
        drawn += triangle_count(t) > 0;
        SurfacePoint p = evaluate(s, chance.number(), chance.number());
        for (dvec3 v : {p.p, p.du, p.dv, p.normal})
            for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(v[c]));
    }
    EXPECT_GT(drawn, 500u);
}

}  // namespace
}  // namespace kinora
