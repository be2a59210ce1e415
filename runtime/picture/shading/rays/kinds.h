// runtime/picture/shading/rays/kinds.h: the kinds of rays that shaders and lights send, a row each.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <string_view>

#include "runtime/scene/shaders/picture_points.h"

namespace kinora {

enum class RayKind : uint8_t { Trace, Transmission, Occlusion, Indirect, Gather, Lamp };

// How a call pays for its rays (docs/rays.md#budgets).
enum class RayBudget : uint8_t {
    Share,    // each ray has a share of its camera ray's work: too small a share forbids the call
    Fit,      // the same, but too small a share takes samples away
    Samples,  // takes the samples that are left, at any depth
    Free,     // counts for nothing
};

// What becomes known of a ray.
enum class RayFinds : uint8_t {
    Color,    // of all surfaces on its way, what is open behind them, the distance of the nearest
    Passing,  // what all surfaces on its way let through
    Hit,      // the first surface, which the sender has shaded
};

struct RayKindRow {
    RayKind kind;
    std::string_view service;  // of rsl/model/services.def; empty: no shader sends such rays
    RayType type;
    uint32_t sees;  // mask of the geometry that its rays may meet: RayBatch::sees
    RayBudget budget;
    RayFinds finds;
    bool noted;  // calls wait for those of other points (docs/rays.md#full-packets)
};

// In the order of RayKind.
std::span<const RayKindRow> ray_kinds();
inline const RayKindRow& row_of(RayKind kind) {
    return ray_kinds()[size_t(kind)];
}

// Of points that rays of the kind see, sent from points with the tag `from`.
RayTag sent_tag(const RayTag& from, const RayKindRow& row, int32_t label);

// How many samples of a call count at points with the tag, where it asks for so many: a divisor.
int samples_at(const RayTag& tag, int asked);

// A colour whose largest component is no more than `most`.
inline vec3 dimmed(vec3 color, double most) {
    const float largest = std::max({color.x, color.y, color.z});
    return largest > float(most) ? color * (float(most) / largest) : color;
}

// Depths at which rays are sent: of the hit that sends them.
struct RayDepth {
    uint32_t depth, diffuse;            // rays on the way from the eye; diffuse ones of these
    uint32_t most_depth, most_diffuse;  // --rays, --bounces
};
// Whether depth forbids rays of the kind.
bool is_too_deep(const RayKindRow& row, const RayDepth& at);

}  // namespace kinora
