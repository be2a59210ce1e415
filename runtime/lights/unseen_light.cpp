// runtime/lights/unseen_light.cpp: lights behind surfaces, and lights that others outshine.
#include "runtime/lights/unseen_light.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "rsl/lower/lower.h"

namespace kinora {

namespace {

constexpr float kLargest = std::numeric_limits<float>::max();
// Sine of the angle about 90 degrees within which a kernel's rounding may decide.
constexpr float kUnseenMargin = 1e-4f, kMargin2 = kUnseenMargin * kUnseenMargin;
constexpr float kLeastSquare = 1e-30f;  // of a vector whose direction kernels see as we do

float square(const float* const v[3], size_t i) {
    return v[0][i] * v[0][i] + v[1][i] * v[1][i] + v[2][i] * v[2][i];
}
float dot(const float* const a[3], const float* const b[3], size_t i) {
    return a[0][i] * b[0][i] + a[1][i] * b[1][i] + a[2][i] * b[2][i];
}

// How much a product of two vectors surely tells: its sign, 0 where rounding may decide.
float side(float product, float square_a, float square_b) {
    const float p2 = product * product;
    const bool sure = p2 >= kMargin2 * square_a * square_b && p2 <= kLargest &&
                      square_a > kLeastSquare && square_b > kLeastSquare;
    return sure ? std::copysign(1.0f, product) : 0.0f;
}

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
void find_signs(const SeenPoints& points, const SideRow& row, std::span<float> signs) {
    std::fill(signs.begin(), signs.end(), row.opposite ? -1.0f : 1.0f);
    if (!row.judged_by) return;
    const float* const* judge = points.*row.judged_by;
    if (!known(judge) || !known(points.I)) return std::fill(signs.begin(), signs.end(), 0.0f);
    for (size_t i = 0; i < signs.size(); ++i)
        signs[i] *= -side(dot(judge, points.I, i), square(judge, i), square(points.I, i));
}

float strength(const SentLight& light, size_t i) {
    const float r = std::abs(light.Cl[0][i]), g = std::abs(light.Cl[1][i]),
                b = std::abs(light.Cl[2][i]);
    return r + g + b <= kLargest ? std::max({r, g, b}) : 0.0f;  // what is no number stays as it is
}

void darken(const SentLight& light, size_t i) {
    for (float* Cl : light.Cl) Cl[i] = 0;
}

}  // namespace

void drop_behind(const SeenPoints& points, Arena& arena, std::span<const SentLight> lights) {
    if (points.sides & rsl::kLitAround || !known(points.N)) return;
    const Arena::Mark mark = arena.mark();
    auto row_of = [&](float value) {
        std::span<float> values = arena.allocate_span<float>(points.count);
        std::fill(values.begin(), values.end(), value);
        return values;
    };
    // Whether light along N is seen, and light against it.
    std::span<float> signs = row_of(0), along = row_of(0), against = row_of(0);
    for (const SideRow& row : kSides) {
        if (!(points.sides & row.side)) continue;
        find_signs(points, row, signs);
        for (size_t i = 0; i < points.count; ++i) {
            along[i] = signs[i] >= 0 ? 1.0f : along[i];
            against[i] = signs[i] <= 0 ? 1.0f : against[i];
        }
    }
    for (const SentLight& light : lights)
        for (size_t i = 0; light.casts && i < points.count; ++i) {
            const float from =
                side(dot(points.N, light.L, i), square(points.N, i), square(light.L, i));
            const bool seen = from > 0 ? along[i] != 0 : from < 0 ? against[i] != 0 : true;
            if (!seen && strength(light, i) > 0) darken(light, i);
        }
    arena.release(mark);
}

void drop_weak(float share, size_t points, Arena& arena, std::span<const SentLight> lights) {
    if (share <= 0 || lights.size() < 2) return;
    // Strengths up to the limit, summed by their exponents below the limit's.
    constexpr int kExponents = 16;
    struct Point {
        float limit = 0;
        float sums[kExponents] = {};
        int first = 0;  // exponents from here on go
    };
    const Arena::Mark mark = arena.mark();
    std::span<Point> at = arena.allocate_span<Point>(points);
    std::fill(at.begin(), at.end(), Point{});
    auto exponent = [](float x) { return std::bit_cast<int32_t>(x) >> 23; };
    auto place = [&](const Point& p, float x) {
        return std::min(exponent(p.limit) - exponent(x), kExponents - 1);
    };
    for (const SentLight& light : lights)
        for (size_t i = 0; i < points; ++i) at[i].limit += share * strength(light, i);
    for (const SentLight& light : lights)
        for (size_t i = 0; light.casts && i < points; ++i)
            if (const float x = strength(light, i); x > 0 && x <= at[i].limit)
                at[i].sums[place(at[i], x)] += x;
    for (Point& p : at) {
        float sum = 0;
        for (p.first = kExponents; p.first > 0; --p.first)
            if ((sum += p.sums[p.first - 1]) > p.limit) break;
    }
    for (const SentLight& light : lights)
        for (size_t i = 0; light.casts && i < points; ++i)
            if (const float x = strength(light, i);
                x > 0 && x <= at[i].limit && place(at[i], x) >= at[i].first)
                darken(light, i);
    arena.release(mark);
}

}  // namespace kinora
