// runtime/picture/shading/rays/map_directions.h: the directions of rays over an environment map.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/geometric.hpp>

#include "raytrace/sampling.h"
#include "runtime/picture/rays/cone.h"
#include "runtime/scene/images/environment_table.h"

namespace kinora {

// The directions of one lane over a map: every other one by the map's brightness where a table is
// given, the rest over the cone. Which of the two come first is drawn at random, so that one alone
// may be either. A direction counts 1 over the density of them all (E. Veach's balance heuristic),
// so sums have the mean of directions in the cone.
class MapDirections {
  public:
    MapDirections() = default;
    MapDirections(const Cone& cone, const EnvironmentTable* table, uint32_t seed)
        : cone_(cone), table_(table), seed_(seed), first_(raytrace::hash(seed, 2u) & 1) {}

    vec3 direction(uint32_t k) const {
        if (!table_) return cone_.direction(k, seed_);
        if ((k & 1) == first_) return cone_.direction(k / 2, seed_);
        return table_->direction(raytrace::stratified_sample(k / 2, raytrace::hash(seed_, 1u)));
    }
    // Of a sample, per solid angle.
    float density(vec3 d) const {
        return table_ ? (cone_density(d) + table_->density(d)) / 2 : cone_density(d);
    }
    // The solid angle that each of n directions stands for; 0: outside the cone.
    float solid_angle(vec3 d, int n) const { return holds(d) ? 1 / (float(n) * density(d)) : 0; }
    // What a direction counts in the mean of those in the cone.
    float weight(vec3 d) const {
        return table_ && holds(d) ? cone_density(d) / density(d) : table_ ? 0.0f : 1.0f;
    }

  private:
    bool holds(vec3 d) const { return glm::dot(d, cone_.z) > cone_.cosine - 1e-6f; }
    float cone_density(vec3 d) const {
        const float c = cone_.cosine;
        if (!cone_.by_cosine) return 1 / (2 * float(kPi) * (1 - c));
        return std::max(glm::dot(d, cone_.z), 1e-6f) / (float(kPi) * (1 - c * c));
    }

    Cone cone_;
    const EnvironmentTable* table_ = nullptr;
    uint32_t seed_ = 0, first_ = 0;
};

}  // namespace kinora
