// jit/math_noise.cpp: gradient noise on an integer hash of the lattice, as IR.
#include "jit/math_noise_p.h"

#include <array>

#include "jit/math_expr_p.h"

namespace kinora::jit::math {
namespace {

// What one coordinate contributes to the 2 lattice planes around the point.
struct Axis {
    Int key[2];       // multiplied lattice coordinate of the lower and the upper plane
    Num distance[2];  // from the plane to the point
    Num weight;       // of the upper plane
};

Num clamped(Num x) {
    return at_most(at_least(x, num(x, -kLatticeLimit)), num(x, kLatticeLimit));  // NaN: the lower
}

Num fade(Num t) {
    Num cubic = fma(t, fma(t, 6.0f, -15.0f), 10.0f);
    return (t * t) * (t * cubic);
}

// cell modulo period. The quotient in float may be off by up to 2^-24 of itself, so a second step
// takes what the first left over, and the last corrections are by one period.
Int wrapped(Int cell, Int period) {
    for (int step = 0; step < 2; ++step)
        cell = cell - truncate(floor(to_float(cell) / to_float(period))) * period;
    cell = select(cell < 0, cell + period, cell);
    return cell - select((cell - period) < 0, integer(cell, 0), period);
}

// The two planes around a point of a periodic lattice; the period is a whole number, at least 1
// (EXTREMES.md row 70).
std::array<Int, 2> periodic_planes(Num cell, Num period) {
    Int whole = truncate(at_most(at_least(period, num(cell, 1.0f)), num(cell, kLatticeLimit)));
    Int lower = wrapped(truncate(cell), whole);
    Int next = lower + 1;
    return {lower, select((next - whole) < 0, next, integer(next, 0))};
}

Axis axis(Num coordinate, const Num* period, size_t dimension) {
    Num x = clamped(coordinate);
    Num cell = floor(x);
    Num t = x - cell;
    auto multiplier = int32_t(kLattice[dimension]);
    Axis out{{}, {t, t - 1.0f}, fade(t)};
    if (period == nullptr) {
        out.key[0] = truncate(cell) * multiplier;
        out.key[1] = out.key[0] + multiplier;
    } else {
        std::array<Int, 2> planes = periodic_planes(cell, *period);
        out.key[0] = planes[0] * multiplier;
        out.key[1] = planes[1] * multiplier;
    }
    return out;
}

// The hashes of the 2^n corners; bit d of the index is the plane along dimension d.
std::vector<Int> corner_hashes(std::span<const Axis> axes) {
    const Axis& last = axes.back();
    std::vector<Int> hashes = {last.key[0] ^ int32_t(kLatticeSeed),
                               last.key[1] ^ int32_t(kLatticeSeed)};
    for (size_t d = axes.size() - 1; d-- > 0;) {
        std::vector<Int> wider;
        for (Int h : hashes)
            for (Int key : axes[d].key) wider.push_back(h ^ key);
        hashes = wider;
    }
    return hashes;
}

// gradient . (p - corner), times 2^31
Num corner_value(std::span<const Axis> axes, size_t corner, Int hash, size_t component) {
    Int g = hash * (hash ^ int32_t(kGradient[component]));
    Num sum = to_float(g) * axes[0].distance[corner & 1];
    for (size_t d = 1; d < axes.size(); ++d)
        sum = fma(to_float(g << kGradientShift[d]), axes[d].distance[corner >> d & 1], sum);
    return sum;
}

Num interpolated(std::span<const Axis> axes, std::vector<Num> corners) {
    for (const Axis& a : axes) {
        for (size_t i = 0; i < corners.size() / 2; ++i)
            corners[i] = fma(a.weight, corners[2 * i + 1] - corners[2 * i], corners[2 * i]);
        corners.resize(corners.size() / 2);
    }
    return corners[0];
}

std::vector<Value> noise_body(std::span<const Num> params, size_t dimensions, size_t components) {
    std::vector<Axis> axes;
    bool periodic = params.size() > dimensions;
    for (size_t d = 0; d < dimensions; ++d)
        axes.push_back(axis(params[d], periodic ? &params[dimensions + d] : nullptr, d));
    std::vector<Int> hashes = corner_hashes(axes);
    std::vector<Value> results;
    for (size_t k = 0; k < components; ++k) {
        std::vector<Num> corners;
        for (size_t i = 0; i < hashes.size(); ++i)
            corners.push_back(corner_value(axes, i, hashes[i], k));
        Num sum = interpolated(axes, corners);
        Num value = fma(sum, kNoiseScale[dimensions - 1] * 0x1p-32f, 0.5f);
        if (dimensions > 1) value = at_most(at_least(value, num(value, 0)), num(value, 1));
        results.push_back(value.v);
    }
    return results;
}

Int hash_rounds(Int h) {
    for (uint32_t multiplier : kRoundMultiplier) {
        h = h ^ shift_right(h, 16);
        h = h * int32_t(multiplier);
    }
    return h ^ shift_right(h, 16);
}

Int mixed_keys(std::span<const Int> keys) {
    Int h = integer(keys[0], int32_t(kKeySeed));
    for (Int key : keys) {
        h = (h ^ key) * int32_t(kKeyMultiplier);
        h = h ^ shift_right(h, 15);
    }
    return h;
}

// The upper 24 bits as a number in [0, 1).
Num unit_float(Int h) {
    return to_float(shift_right(h, 8)) * 0x1p-24f;
}

}  // namespace

std::vector<Value> noise(Builder& b, Value mask, std::span<const Value> p, int components,
                         std::span<const Value> period) {
    std::string name = std::string(period.empty() ? "noise" : "pnoise") + std::to_string(p.size()) +
                       "." + std::to_string(components);
    std::vector<Value> args(p.begin(), p.end());
    args.insert(args.end(), period.begin(), period.end());
    return call_function(b, name, std::vector<Type>(size_t(components), Type::F), mask, args,
                         [&](std::span<const Num> params) {
                             return noise_body(params, p.size(), size_t(components));
                         });
}

std::vector<Value> cellnoise(Builder& b, std::span<const Value> p, int components) {
    std::vector<Int> cells;
    for (Value x : p) cells.push_back(truncate(floor(clamped({&b, x}))));
    Int h = mixed_keys(cells);
    std::vector<Value> results;
    for (uint32_t k = 0; k < uint32_t(components); ++k)
        results.push_back(unit_float(hash_rounds(h + int32_t(k * kComponentStep))).v);
    return results;
}

Value hash01(Builder& b, std::span<const Value> int_keys) {
    std::vector<Int> keys;
    for (Value key : int_keys) keys.push_back({&b, key});
    return unit_float(hash_rounds(mixed_keys(keys))).v;
}

}  // namespace kinora::jit::math
