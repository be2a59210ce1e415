// jit/math/noise.cpp: gradient noise on an integer hash of the lattice, as IR.
#include "jit/math/noise_p.h"

#include <array>

#include "jit/math/expr_p.h"

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
// (docs/numerics.md#noise).
std::array<Int, 2> periodic_planes(Num cell, Num period) {
    Int whole = truncate(at_most(at_least(period, num(cell, 1.0f)), num(cell, kLatticeLimit)));
    Int lower = wrapped(truncate(cell), whole);
    Int next = lower + 1;
    return {lower, select((next - whole) < 0, next, integer(next, 0))};
}

// Values are made in an order that keeps machines busy with few registers: the lattice of all axes
// first, since everything waits for it, weights and corners when they are asked for.
std::vector<Axis> make_axes(std::span<const Num> coordinates, std::span<const Num> periods) {
    std::vector<Num> x, cell;
    for (Num coordinate : coordinates) x.push_back(clamped(coordinate));
    for (Num at : x) cell.push_back(floor(at));
    std::vector<Axis> axes;
    for (size_t d = 0; d < x.size(); ++d) {
        auto multiplier = int32_t(kLattice[d]);
        Num t = x[d] - cell[d];
        Axis axis{{}, {t, t}, {nullptr, kNone}};
        if (periods.empty()) {
            axis.key[0] = truncate(cell[d]) * multiplier;
            axis.key[1] = axis.key[0] + multiplier;
        } else {
            std::array<Int, 2> planes = periodic_planes(cell[d], periods[d]);
            axis.key[0] = planes[0] * multiplier;
            axis.key[1] = planes[1] * multiplier;
        }
        axes.push_back(axis);
    }
    for (Axis& axis : axes) axis.distance[1] = axis.distance[0] - 1.0f;
    for (Axis& axis : axes) axis.weight = fade(axis.distance[0]);
    for (Int& key : axes.back().key) key = key ^ int32_t(kLatticeSeed);
    return axes;
}

// gradient . (p - corner), times 2^31, at the two corners of an edge along dimension 0: side by
// side, so that neither waits for its own last step.
std::array<Num, 2> edge_values(std::span<const Axis> axes, size_t corner,
                               const std::array<Int, 2>& hash, size_t component) {
    auto C = int32_t(kGradient[component]);
    Int g[2] = {hash[0] * (hash[0] ^ C), hash[1] * (hash[1] ^ C)};
    std::array<Num, 2> sum = {to_float(g[0]) * axes[0].distance[0],
                              to_float(g[1]) * axes[0].distance[1]};
    for (size_t d = 1; d < axes.size(); ++d)
        for (size_t end = 0; end < 2; ++end)
            sum[end] = fma(to_float(g[end] << kGradientShift[d]), axes[d].distance[corner >> d & 1],
                           sum[end]);
    return sum;
}

// The components between the corners that lie on the planes chosen so far: bit d of `corner` is the
// plane along dimension d, `hash` the keys of those >= dimensions (none: the last axis begins it).
std::vector<Num> interpolated(std::span<const Axis> axes, size_t dimensions, size_t corner,
                              Int hash, size_t components) {
    const Axis& axis = axes[dimensions - 1];
    std::array<Int, 2> hashes = {axis.key[0], axis.key[1]};
    if (dimensions < axes.size()) hashes = {hash ^ hashes[0], hash ^ hashes[1]};
    std::vector<Num> values[2];
    if (dimensions == 1) {
        for (size_t k = 0; k < components; ++k) {
            std::array<Num, 2> ends = edge_values(axes, corner, hashes, k);
            for (size_t end = 0; end < 2; ++end) values[end].push_back(ends[end]);
        }
    } else {
        for (size_t plane = 0; plane < 2; ++plane)
            values[plane] = interpolated(axes, dimensions - 1, corner | plane << (dimensions - 1),
                                         hashes[plane], components);
    }
    for (size_t k = 0; k < components; ++k)
        values[0][k] = fma(axis.weight, values[1][k] - values[0][k], values[0][k]);
    return values[0];
}

std::vector<Value> noise_body(std::span<const Num> params, size_t dimensions, size_t components) {
    std::vector<Axis> axes = make_axes(params.first(dimensions), params.subspan(dimensions));
    std::vector<Value> results;
    for (Num sum : interpolated(axes, dimensions, 0, {}, components)) {
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
