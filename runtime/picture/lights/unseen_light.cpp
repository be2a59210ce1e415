// runtime/picture/lights/unseen_light.cpp: lights behind surfaces, and lights that others outshine.
#include "runtime/picture/lights/unseen_light.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "rsl/lower/lower.h"
#include "runtime/base/math.h"
#include "runtime/picture/lights/kernels.h"

namespace kinora {

namespace {

using Row = std::span<float>;

// A side, and whether it looks along N or against it.
struct SideRow {
    rsl::LitSide side;
    bool opposite;
    const float* (SeenPoints::*judged_by)[3];  // null: it is the same everywhere
};
const SideRow kSides[] = {
    {rsl::kLitN, false, nullptr},
    {rsl::kLitBehindN, true, nullptr},
    {rsl::kLitFacing, false, &SeenPoints::Ng},
    {rsl::kLitAverted, true, &SeenPoints::Ng},
    {rsl::kLitFacingByN, false, &SeenPoints::N},
    {rsl::kLitAvertedByN, true, &SeenPoints::N},
};

bool known(const float* const v[3]) {
    return v[0] && v[1] && v[2];
}

// For each point 1 where the side looks along N, -1 where against it, 0 where that is not sure.
void find_signs(const SeenPoints& points, const SideRow& row, Row signs) {
    std::fill(signs.begin(), signs.end(), row.opposite ? -1.0f : 1.0f);
    if (!row.judged_by) return;
    const float* const* judge = points.*row.judged_by;
    if (!known(judge) || !known(points.I)) return std::fill(signs.begin(), signs.end(), 0.0f);
    light_kernels().turn_signs(judge, points.I, signs.size(), signs.data());
}

// The largest component of its colour, 0 of what is no number: that stays as it is.
float strength(const SentLight& light, size_t i) {
    const float r = std::abs(light.Cl[0][i]), g = std::abs(light.Cl[1][i]),
                b = std::abs(light.Cl[2][i]);
    return r + g + b <= std::numeric_limits<float>::max() ? std::max({r, g, b}) : 0.0f;
}

void darken(const SentLight& light, size_t i) {
    for (float* Cl : light.Cl) Cl[i] = 0;
}

}  // namespace

namespace {

// Whether light along N is seen at each point, and light against it.
struct SeenSides {
    SeenSides(const SeenPoints& points, Arena& arena)
        : along(row_of(points, 0, arena)), against(row_of(points, 0, arena)) {
        Row signs = row_of(points, 0, arena);
        for (const SideRow& row : kSides) {
            if (!(points.sides & row.side)) continue;
            find_signs(points, row, signs);
            for (size_t i = 0; i < points.count; ++i) {
                along[i] = signs[i] >= 0 ? 1.0f : along[i];
                against[i] = signs[i] <= 0 ? 1.0f : against[i];
            }
        }
    }
    static Row row_of(const SeenPoints& points, float value, Arena& arena) {
        Row values = arena.allocate_span<float>(points.count);
        std::fill(values.begin(), values.end(), value);
        return values;
    }
    Row along, against;
};

bool sees_all(const SeenPoints& points) {
    return points.sides & rsl::kLitAround || !known(points.N);
}

}  // namespace

void drop_behind(const SeenPoints& points, Arena& arena, std::span<const SentLight> lights) {
    if (sees_all(points)) return;
    const Arena::Mark mark = arena.mark();
    const SeenSides sides(points, arena);
    for (const SentLight& light : lights)
        if (light.casts)
            light_kernels().darken_unseen(points.N, light.L, sides.along.data(),
                                          sides.against.data(), points.count, light.Cl);
    arena.release(mark);
}

void find_looks(const SeenPoints& points, Arena& arena, float* const looks[3]) {
    for (int k = 0; k < 3; ++k) std::fill_n(looks[k], points.count, 0.0f);
    if (sees_all(points)) return;
    const Arena::Mark mark = arena.mark();
    const SeenSides sides(points, arena);
    for (size_t i = 0; i < points.count; ++i) {
        const vec3 N(points.N[0][i], points.N[1][i], points.N[2][i]);
        const float length = glm::length(N), sign = sides.along[i] - sides.against[i];
        if (sign == 0 || !(length > 0 && std::isfinite(length))) continue;
        for (int k = 0; k < 3; ++k) looks[k][i] = N[k] * (sign / length);
    }
    arena.release(mark);
}

namespace {

// At one point: the strengths of its weak lights are summed by their exponents below the limit's,
// and from some exponent on the lights go.
void drop_weak_at(size_t i, float limit, std::span<const SentLight> lights) {
    constexpr int kExponents = 16;
    auto exponent = [](float x) { return std::bit_cast<int32_t>(x) >> 23; };
    auto bin = [&](float x) { return std::min(exponent(limit) - exponent(x), kExponents - 1); };
    auto for_each_weak = [&](auto&& f) {
        for (const SentLight& light : lights)
            if (const float x = light.casts ? strength(light, i) : 0; x > 0 && x <= limit)
                f(light, x);
    };
    float sums[kExponents] = {}, sum = 0;
    for_each_weak([&](const SentLight&, float x) { sums[bin(x)] += x; });
    int first = kExponents;
    for (; first > 0; --first)
        if ((sum += sums[first - 1]) > limit) break;
    for_each_weak([&](const SentLight& light, float x) {
        if (bin(x) >= first) darken(light, i);
    });
}

}  // namespace

void drop_weak(float share, size_t points, Arena& arena, std::span<const SentLight> lights) {
    if (share <= 0 || lights.size() < 2) return;
    const Arena::Mark mark = arena.mark();
    const LightKernels& kernels = light_kernels();
    Row limits = arena.allocate_span<float>(points);
    std::span<uint32_t> weak = arena.allocate_span<uint32_t>(points);
    std::fill(limits.begin(), limits.end(), 0.0f);
    std::fill(weak.begin(), weak.end(), 0u);
    for (const SentLight& light : lights)
        kernels.add_strengths(light.Cl, share, points, limits.data());
    bool any = false;
    for (const SentLight& light : lights)
        any |= light.casts && kernels.mark_weak(light.Cl, limits.data(), points, weak.data());
    for (size_t i = 0; any && i < points; ++i)
        if (weak[i]) drop_weak_at(i, limits[i], lights);
    arena.release(mark);
}

}  // namespace kinora
