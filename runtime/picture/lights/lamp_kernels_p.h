// runtime/picture/lights/lamp_kernels_p.h: the kernels of lamp_kernels.h in plain C++. The compiler
// makes vectors of the loop. Every operation rounds once (no contraction), so all widths give the
// same bits.
#pragma once

#include <cstdint>

#include "runtime/picture/lights/lamp_kernels.h"

namespace kinora {
namespace {

#define KINORA_LAMP_PART __attribute__((always_inline)) inline

constexpr float kMostLight = 1e30f;  // of a lamp, at its own place too
// A light behind the side counts this much: surfaces may mirror what their normal does not see.
constexpr float kLeastCosine = 0.02f;
constexpr float kEdgeLeeway = 1e-4f;  // cosines of edges are known so well
constexpr float kTiny = 1e-30f;

KINORA_LAMP_PART float lesser(float a, float b) {
    return a < b ? a : b;
}
KINORA_LAMP_PART float greater(float a, float b) {
    return a > b ? a : b;
}

// About x to the power e, for x in (0, 1]: the logarithm and the power of two by parabolas between
// whole exponents, a hundredth off.
KINORA_LAMP_PART float rough_power(float x, float e) {
    const auto bits = __builtin_bit_cast(int32_t, x);
    const auto m = __builtin_bit_cast(float, (bits & 0x7fffff) | 0x3f800000);
    const float log2 = float((bits >> 23) - 127) + (m - 1) * (1.3333334f - 0.3333333f * (m - 1));
    const float y = greater(e * log2, -100.0f);
    const auto whole = int32_t(y) - int32_t(y < 0);
    const float part = y - float(whole);
    return __builtin_bit_cast(float, (whole + 127) << 23) *
           (1 + part * (0.6666667f + 0.3333333f * part));
}

// 1 where all lamps of a lane may have the point within their cones, 0 where none; 0.5 where that
// is not known. The angle to the axis is known up to the one that the lane's sphere fills.
KINORA_LAMP_PART float share_within(float cosine, float sphere_sine, float edge, float mixed) {
    const float sine = lesser(sphere_sine, 1.0f);
    const float across = __builtin_sqrtf(greater(1 - cosine * cosine, 0.0f)),
                along = __builtin_sqrtf(1 - sine * sine);
    const float nearest = cosine >= along ? 1.0f : cosine * along + across * sine;
    const float farthest = cosine <= -along ? -1.0f : cosine * along - across * sine;
    const float outside = sine < 1 ? 1.0f : 0.0f;
    const float none = nearest < edge - kEdgeLeeway ? outside : 0.0f,
                all = farthest >= edge ? outside * (1 - mixed) : 0.0f;
    const float within = (1 - none) * (0.5f + 0.5f * all);
    return edge <= -1 ? 1.0f : within;
}

// What a cone takes of the light within it.
KINORA_LAMP_PART float cone_light(float cosine, float edge, float slope, float exponent) {
    const float power = rough_power(greater(cosine, 1e-6f), exponent);
    const float at = greater(lesser((cosine - edge) * slope, 1.0f), 0.0f);
    const float soft = at * at * (3 - 2 * at);
    return (exponent > 0 ? power : 1.0f) * (slope > 0 ? soft : 1.0f);
}

struct SeenLamp {
    float light, doubt;
};

// What a lane's cone leaves of its light at a point, and whether that is known.
struct SeenCone {
    float light, within;
};
KINORA_LAMP_PART SeenCone see_cone(const LampLanes& lamps, size_t i, float dx, float dy, float dz,
                                   float shorter, float sphere_sine) {
    const float *ax = lamps.axis[0], *ay = lamps.axis[1], *az = lamps.axis[2];
    const float *edge = lamps.edge, *slope = lamps.slope, *exponent = lamps.exponent;
    const float* mixed = lamps.mixed;
    const float cosine = -(dx * ax[i] + dy * ay[i] + dz * az[i]) * shorter;
    const float within = share_within(cosine, sphere_sine, edge[i], mixed[i]);
    return {within * cone_light(cosine, edge[i], slope[i], exponent[i]), within};
}

// Lane i at a point. kCones: some lane of the block has a cone.
template <bool kCones>
KINORA_LAMP_PART SeenLamp see_lane(const LampLanes& lamps, size_t i, float x, float y, float z,
                                   float nx, float ny, float nz) {
    const float *cx = lamps.center[0], *cy = lamps.center[1], *cz = lamps.center[2];
    const float *constant = lamps.fall[0], *linear = lamps.fall[1], *quadratic = lamps.fall[2];
    const float *radii = lamps.radius, *spread = lamps.spread, *strength = lamps.strength;
    const float* range = lamps.range;
    const float dx = cx[i] - x, dy = cy[i] - y, dz = cz[i] - z;
    const float square = dx * dx + dy * dy + dz * dz, radius = radii[i];
    const float distance = __builtin_sqrtf(square), shorter = 1 / greater(distance, kTiny);
    const float far2 = square + spread[i], far = __builtin_sqrtf(far2);
    const float falls = constant[i] + far * (linear[i] + far * quadratic[i]);
    const float bare = lesser(strength[i] / greater(falls, kTiny), kMostLight);
    const float facing = (nx * dx + ny * dy + nz * dz + radius) * shorter;
    const float least = nx * nx + ny * ny + nz * nz > 0 ? kLeastCosine : 1.0f;
    const float sphere_sine = radius < distance ? radius * shorter : 1.0f;
    const float wide = lesser(radius * radius / greater(far2, kTiny), 1.0f);
    SeenCone cone{1, 1};
    if constexpr (kCones) cone = see_cone(lamps, i, dx, dy, dz, shorter, sphere_sine);
    const float all = bare * lesser(greater(facing, least), 1.0f) * cone.light;
    const float unsure = cone.within < 1 ? 1.0f : wide;
    return {distance - radius > range[i] ? 0.0f : all, radius > 0 ? unsure : 0.0f};
}

template <bool kCones>
void see_lanes(const LampLanes& lamps, const float P[3], const float side[3], float* light,
               float* doubt) {
    const float x = P[0], y = P[1], z = P[2], nx = side[0], ny = side[1], nz = side[2];
#pragma GCC ivdep
    for (size_t i = 0; i < kLampLanes; ++i) {
        const SeenLamp seen = see_lane<kCones>(lamps, i, x, y, z, nx, ny, nz);
        light[i] = seen.light;
        doubt[i] = seen.doubt;
    }
}

void see(const LampLanes& lamps, const float P[3], const float side[3], float* light,
         float* doubt) {
    lamps.cones ? see_lanes<true>(lamps, P, side, light, doubt)
                : see_lanes<false>(lamps, P, side, light, doubt);
}

// ---- choosing -----------------------------------------------------------------------------------

using PointRow = float[kLampPoints];

// The tree as it is opened for points.
struct Opening {
    const LampBlock* tree;
    const LampPoints& points;
    const LampParts& parts;
    float wanted;
    size_t count = 0;                  // of parts
    alignas(64) PointRow total = {};   // the light of all parts, as far as it is known
    alignas(64) PointRow opened = {};  // blocks
};

// The light of a lane at the points that have `active` 1.
template <bool kCones>
void see_points(const LampLanes& lamps, size_t lane, const LampPoints& points,
                const PointRow& active, PointRow& light, PointRow& doubt) {
    const float *x = points.P[0], *y = points.P[1], *z = points.P[2];
    const float *nx = points.side[0], *ny = points.side[1], *nz = points.side[2];
#pragma GCC ivdep
    for (size_t p = 0; p < kLampPoints; ++p) {
        const SeenLamp seen = see_lane<kCones>(lamps, lane, x[p], y[p], z[p], nx[p], ny[p], nz[p]);
        const float arrives = seen.light > 0 ? seen.light : 0.0f;  // what is no number does not
        light[p] = arrives * active[p];
        doubt[p] = seen.doubt;
    }
}

// Whether points open a group: much of all light may be other than it seems, or it would be chosen
// more than once. Leaves its light only where it stays closed.
bool open_group(Opening& opening, const PointRow& doubt, PointRow& light, PointRow& open) {
    constexpr float kLittle = 0.01f, kOften = 2;
    float any = 0;
    for (size_t p = 0; p < kLampPoints; ++p) {
        const float little = light[p] * doubt[p] - kLittle * opening.total[p];
        const float often = kOften * light[p] * opening.wanted - opening.total[p];
        const float matters = greater(little, often) > 0 ? 1.0f : 0.0f;
        open[p] = opening.opened[p] < float(LampParts::kMostOpened) ? matters : 0.0f;
        opening.total[p] -= open[p] * light[p];
        light[p] *= 1 - open[p];
        any += open[p];
    }
    return any > 0;
}

void add_part(Opening& opening, uint32_t block, size_t lane, const PointRow& light) {
    float any = 0;
    for (size_t p = 0; p < kLampPoints; ++p) any = greater(any, light[p]);
    if (!(any > 0)) return;
    opening.parts.parts[opening.count] = {block, uint32_t(lane)};
    __builtin_memcpy(opening.parts.light[opening.count++], light, sizeof(light));
}

void open_block(Opening& opening, uint32_t number, const PointRow& active) {
    const LampBlock& block = opening.tree[number];
    alignas(64) PointRow light[kLampLanes], doubt[kLampLanes];
    size_t lanes = 0;
    for (; lanes < kLampLanes && block.lanes.strength[lanes] > 0; ++lanes) {
        auto* const seen = block.lanes.cones ? see_points<true> : see_points<false>;
        seen(block.lanes, lanes, opening.points, active, light[lanes], doubt[lanes]);
        for (size_t p = 0; p < kLampPoints; ++p) opening.total[p] += light[lanes][p];
    }
    for (size_t p = 0; p < kLampPoints; ++p) opening.opened[p] += active[p];
    for (size_t lane = 0; lane < lanes; ++lane) {
        alignas(64) PointRow open;
        if (block.below[lane] != kOneLamp && open_group(opening, doubt[lane], light[lane], open))
            open_block(opening, block.below[lane], open);
        add_part(opening, number, lane, light[lane]);
    }
}

// Points at equal steps along the parts of each point.
struct Steps {
    const Opening& opening;
    LampHit* hits;
    size_t count = 0;                // of hits
    alignas(64) PointRow left = {};  // to be chosen, of each point
    alignas(64) PointRow step = {};
    alignas(64) PointRow others = {};  // parts that may be chosen

    PointRow& light(size_t part) const { return opening.parts.light[part]; }
    void hit(size_t point, size_t part, float at, float weight) {
        const LampParts::Part of = opening.parts.parts[part];
        hits[count++] = {uint32_t(point), of.block, of.lane, at, weight};
        left[point] -= 1;
    }
};

void find_steps(Steps& steps) {
    alignas(64) PointRow rest = {}, others = {};
    for (size_t part = 0; part < steps.opening.count; ++part) {
        const PointRow& light = steps.light(part);
        for (size_t p = 0; p < kLampPoints; ++p) {
            rest[p] += light[p];
            others[p] += light[p] > 0 ? 1.0f : 0.0f;
        }
    }
    for (size_t p = 0; p < kLampPoints; ++p) {
        steps.step[p] = rest[p] / greater(steps.left[p], 1.0f);
        steps.others[p] = others[p];
    }
}

// A lamp alone that is as long as a step is taken for certain. The last step is for all that are
// left. Whether there was one.
bool take_certain(Steps& steps) {
    const size_t before = steps.count;
    for (size_t part = 0; part < steps.opening.count; ++part) {
        const LampParts::Part of = steps.opening.parts.parts[part];
        if (steps.opening.tree[of.block].below[of.lane] != kOneLamp) continue;
        PointRow& light = steps.light(part);
        float any = 0;
        for (size_t p = 0; p < kLampPoints; ++p) any += light[p] >= steps.step[p] ? light[p] : 0.0f;
        for (size_t p = 0; any > 0 && p < kLampPoints; ++p) {
            if (!(light[p] >= steps.step[p] && light[p] > 0 && steps.left[p] > 0)) continue;
            if (steps.left[p] == 1 && steps.others[p] > 1) continue;
            steps.hit(p, part, 0, 1);
            steps.others[p] -= 1;
            light[p] = 0;
        }
    }
    return steps.count > before;
}

void take_steps(Steps& steps) {
    alignas(64) PointRow at, begin = {}, end;
    for (size_t p = 0; p < kLampPoints; ++p) at[p] = steps.opening.points.start[p] * steps.step[p];
    for (size_t part = 0; part < steps.opening.count; ++part) {
        const PointRow& light = steps.light(part);
        float any = 0;
        for (size_t p = 0; p < kLampPoints; ++p) {
            end[p] = begin[p] + light[p];
            any += at[p] < end[p] ? 1.0f : 0.0f;
        }
        for (size_t p = 0; any > 0 && p < kLampPoints; ++p)
            for (; at[p] < end[p] && light[p] > 0 && steps.left[p] > 0; at[p] += steps.step[p]) {
                const float place = (at[p] - begin[p]) / light[p];
                steps.hit(p, part, greater(lesser(place, 0.9999999f), 0.0f),
                          steps.step[p] / light[p]);
            }
        __builtin_memcpy(begin, end, sizeof(begin));
    }
}

// Goes down to the lamp of a group that hit.at stands for. What is chosen there has its share of
// the group's light as its chance. Whether any light comes from there.
bool go_down(const LampBlock* tree, const LampPoints& points, LampHit& hit) {
    const size_t p = hit.point;
    const float P[] = {points.P[0][p], points.P[1][p], points.P[2][p]};
    const float side[] = {points.side[0][p], points.side[1][p], points.side[2][p]};
    while (tree[hit.block].below[hit.lane] != kOneLamp) {
        hit.block = tree[hit.block].below[hit.lane];
        alignas(32) float light[kLampLanes], doubt[kLampLanes], sums[kLampLanes];
        see(tree[hit.block].lanes, P, side, light, doubt);
        float all = 0;
        for (size_t i = 0; i < kLampLanes; ++i) sums[i] = all += light[i];
        const float left = lesser(hit.at * all, all * 0.9999999f);
        alignas(32) uint32_t passed[kLampLanes];
        for (size_t i = 0; i < kLampLanes; ++i) passed[i] = uint32_t(sums[i] <= left);
        uint32_t lane = 0;
        for (size_t i = 0; i < kLampLanes; ++i) lane += passed[i];
        if (lane == kLampLanes || !(light[lane] > 0)) return false;
        const float before = sums[lane] - light[lane];
        hit.at = greater(lesser((left - before) / light[lane], 0.9999999f), 0.0f);
        hit.weight *= all / light[lane];
        hit.lane = lane;
    }
    return true;
}

size_t choose(const LampBlock* tree, const LampPoints& points, size_t wanted,
              const LampParts& parts, LampHit* hits, ChosenLamp* chosen) {
    Opening opening{tree, points, parts, float(wanted)};
    alignas(64) PointRow active;
    for (size_t p = 0; p < kLampPoints; ++p) active[p] = p < points.count ? 1.0f : 0.0f;
    open_block(opening, 0, active);
    Steps steps{opening, hits};
    for (size_t p = 0; p < kLampPoints; ++p) steps.left[p] = active[p] * float(wanted);
    find_steps(steps);
    while (take_certain(steps)) find_steps(steps);
    take_steps(steps);
    size_t count = 0;
    for (size_t h = 0; h < steps.count; ++h) {
        LampHit& hit = hits[h];
        if (go_down(tree, points, hit))
            chosen[count++] = {tree[hit.block].lamp[hit.lane], hit.point, hit.weight};
    }
    return count;
}

#undef KINORA_LAMP_PART

}  // namespace

extern const LampKernels KINORA_KERNEL_TABLE(Lamps) = {KINORA_INSTRUCTION_SET, see, choose};

}  // namespace kinora
