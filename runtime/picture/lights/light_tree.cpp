// runtime/picture/lights/light_tree.cpp: how the tree of lamps is built, opened and gone down.
#include "runtime/picture/lights/light_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace kinora {

// ---- building -----------------------------------------------------------------------------------

namespace {

constexpr float kLeeway = 1e-4f;  // of angles and lengths that are sums

// A lane of LampLanes.
struct Lane {
    vec3 center{0.0f};
    float radius = 0, spread = 0, strength = 0;
    float fall[3] = {};
    float range = 0;
    vec3 axis{0.0f};
    float edge = 1, slope = 0, exponent = 0, mixed = 0;
};

Lane lane_of(const Lamp& lamp) {
    Lane lane{.center = lamp.position,
              .strength = lamp.strength,
              .range = lamp.range,
              .axis = lamp.axis,
              .edge = lamp.edge,
              .exponent = lamp.exponent};
    std::copy_n(lamp.fall, 3, lane.fall);
    if (lamp.edge > -1 && lamp.inner > lamp.edge + 2 * kLeeway)
        lane.slope = 1 / (lamp.inner - lamp.edge);
    return lane;
}

void set_lane(LampLanes& lanes, size_t i, const Lane& lane) {
    for (int k = 0; k < 3; ++k) {
        lanes.center[k][i] = lane.center[k];
        lanes.fall[k][i] = lane.fall[k];
        lanes.axis[k][i] = lane.axis[k];
    }
    lanes.radius[i] = lane.radius;
    lanes.spread[i] = lane.spread;
    lanes.strength[i] = lane.strength;
    lanes.range[i] = lane.range;
    lanes.edge[i] = lane.edge;
    lanes.slope[i] = lane.slope;
    lanes.exponent[i] = lane.exponent;
    lanes.mixed[i] = lane.mixed;
    lanes.cones |= lane.edge > -1;
}

Lane lane_at(const LampLanes& lanes, size_t i) {
    Lane lane{.radius = lanes.radius[i],
              .spread = lanes.spread[i],
              .strength = lanes.strength[i],
              .range = lanes.range[i],
              .edge = lanes.edge[i],
              .mixed = lanes.mixed[i]};
    for (int k = 0; k < 3; ++k) {
        lane.center[k] = lanes.center[k][i];
        lane.fall[k] = lanes.fall[k][i];
        lane.axis[k] = lanes.axis[k][i];
    }
    return lane;
}

// The cosine of the angle that a cone about `axis` has if it holds another cone.
float cosine_around(vec3 axis, vec3 other, float edge) {
    if (edge <= -1) return -1;
    const double between = std::acos(std::clamp(double(glm::dot(axis, other)), -1.0, 1.0));
    const double wide = between + std::acos(std::min(double(edge), 1.0)) + double(kLeeway);
    return float(std::cos(std::min(wide, kPi)));
}

// What far lamps send together: their strengths over these add up there.
float fall_of_both(float a, float b, float part) {
    return a > 0 && b > 0 ? 1 / ((1 - part) / a + part / b) : 0;
}

Lane joined(const Lane& a, const Lane& b) {
    Lane lane;
    lane.strength = a.strength + b.strength;
    const float part = b.strength / lane.strength;
    lane.center = glm::mix(a.center, b.center, part);
    const float to_a = glm::length(a.center - lane.center),
                to_b = glm::length(b.center - lane.center);
    lane.radius = std::max(to_a + a.radius, to_b + b.radius) * (1 + kLeeway);
    lane.spread = (1 - part) * (a.spread + to_a * to_a) + part * (b.spread + to_b * to_b);
    for (int k = 0; k < 3; ++k) lane.fall[k] = fall_of_both(a.fall[k], b.fall[k], part);
    if (!(lane.fall[0] + lane.fall[1] + lane.fall[2] > 0)) std::copy_n(b.fall, 3, lane.fall);
    lane.range = std::max(a.range, b.range);
    const vec3 axis = glm::mix(a.axis, b.axis, part);
    lane.axis = glm::length(axis) > kLeeway ? glm::normalize(axis) : a.axis;
    lane.edge = std::min(cosine_around(lane.axis, a.axis, a.edge),
                         cosine_around(lane.axis, b.axis, b.edge));
    constexpr float kAlike = 0.01f;
    const bool alike = lane.edge > std::max(a.edge, b.edge) - kAlike;
    lane.mixed = a.mixed > 0 || b.mixed > 0 || !alike ? 1 : 0;
    return lane;
}

Lane joined(const LampLanes& lanes) {
    Lane all = lane_at(lanes, 0);
    for (size_t i = 1; i < kLampLanes && lanes.strength[i] > 0; ++i)
        all = joined(all, lane_at(lanes, i));
    return all;
}

}  // namespace

void LightTree::build(std::span<const Lamp> lamps) {
    lamps_.assign(lamps.begin(), lamps.end());
    blocks_.clear();
    order_.clear();
    for (uint32_t l = 0; l < lamps.size(); ++l)
        if (lamps[l].strength > 0) order_.push_back(l);
    blocks_.reserve(order_.size() / 2 + 1);
    if (!order_.empty()) add({0, uint32_t(order_.size())});
}

// A block of the group; its number.
uint32_t LightTree::add(Group group) {
    const auto own = uint32_t(blocks_.size());
    blocks_.emplace_back();
    std::array<Group, kLampLanes> groups{group};
    size_t count = 1;
    while (count < kLampLanes) {
        const auto largest =
            std::max_element(groups.begin(), groups.begin() + count,
                             [](const Group& a, const Group& b) { return a.count < b.count; });
        if (largest->count == 1) break;
        groups[count++] = split(*largest);
    }
    std::sort(groups.begin(), groups.begin() + count,
              [](const Group& a, const Group& b) { return a.first < b.first; });
    for (size_t i = 0; i < count; ++i) {
        const uint32_t lamp = order_[groups[i].first];
        const uint32_t below = groups[i].count > 1 ? add(groups[i]) : kOneLamp;
        blocks_[own].below[i] = below;
        blocks_[own].lamp[i] = lamp;
        set_lane(blocks_[own].lanes, i,
                 below == kOneLamp ? lane_of(lamps_[lamp]) : joined(blocks_[below].lanes));
    }
    return own;
}

// Leaves in the group what lies in the lower half of its box's longest side, or the first half of
// them in the order of that axis where they lie close together; the others.
LightTree::Group LightTree::split(Group& group) {
    const auto begin = order_.begin() + group.first, end = begin + group.count;
    vec3 low = lamps_[*begin].position, high = low;
    for (auto l = begin; l != end; ++l) {
        low = glm::min(low, lamps_[*l].position);
        high = glm::max(high, lamps_[*l].position);
    }
    const vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const float middle = low[axis] + 0.5f * size[axis];
    auto half =
        std::partition(begin, end, [&](uint32_t l) { return lamps_[l].position[axis] < middle; });
    const auto least = int64_t(group.count / 16);  // so the tree is not deep
    if (half - begin <= least || end - half <= least) {
        half = begin + group.count / 2;
        std::nth_element(begin, half, end, [&](uint32_t a, uint32_t b) {
            const float x = lamps_[a].position[axis], y = lamps_[b].position[axis];
            return x != y ? x < y : a < b;
        });
    }
    const Group rest{uint32_t(half - order_.begin()), uint32_t(end - half)};
    group.count = uint32_t(half - begin);
    return rest;
}

// ---- choosing -----------------------------------------------------------------------------------

size_t LightTree::choose(const LampPoints& points, size_t wanted, Arena& arena,
                         std::span<ChosenLamp> chosen) const {
    if (empty() || wanted == 0 || points.count == 0) return 0;
    const Arena::Mark mark = arena.mark();
    const LampParts parts{arena.allocate_span<LampParts::Part>(LampParts::kRoom).data(),
                          static_cast<float(*)[kLampPoints]>(
                              arena.allocate(LampParts::kRoom * sizeof(float[kLampPoints])))};
    LampHit* const hits = arena.allocate_span<LampHit>(wanted * kLampPoints).data();
    const size_t count =
        lamp_kernels().choose(blocks_.data(), points, wanted, parts, hits, chosen.data());
    arena.release(mark);
    return count;
}

}  // namespace kinora
