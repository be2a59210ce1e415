// runtime/picture/shading/rays/map_light.h: light of environment maps, and the rays of a gather
// over one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <span>

#include "raytrace/sampling.h"
#include "runtime/picture/rays/cone.h"
#include "runtime/scene/images/environment_table.h"

namespace kinora {

class TextureStore;

// Light of an environment map along directions in world space, filtered over `width` radians.
void light_of_map(TextureStore& store, int32_t map, std::span<const vec3> directions, float width,
                  vec3* light);

// The directions of one lane over a map: of n, every other one by the map's brightness where a
// table is given, the rest over the cone. The solid angle of each is 1 over the density of them all
// (E. Veach's balance heuristic), so sums over solid angles have the mean of even directions.
class MapDirections {
  public:
    MapDirections(const Cone& cone, const EnvironmentTable* table, int n)
        : cone_(cone), table_(n > 1 ? table : nullptr), of_table_(table_ ? n / 2 : 0), n_(n) {}

    vec3 direction(uint32_t k, uint32_t seed) const {
        if (!table_) return cone_.direction(k, seed);
        if (k % 2 == 0) return cone_.direction(k / 2, seed);
        return table_->direction(raytrace::stratified_sample(k / 2, raytrace::hash(seed, 1u)));
    }
    // 0: outside the cone.
    float solid_angle(vec3 d) const {
        if (table_ && glm::dot(d, cone_.z) < cone_.cosine) return 0;
        float density = float(n_ - of_table_) / (2 * float(kPi) * (1 - cone_.cosine));
        if (table_) density += float(of_table_) * table_->density(d);
        return 1 / density;
    }

    // Of a look at the map. One for all where densities differ: a wide look beside what is bright
    // would count it twice.
    float width(float solid_angle) const {
        return table_ ? EnvironmentTable::kWidth : std::sqrt(solid_angle);
    }

  private:
    const Cone& cone_;
    const EnvironmentTable* table_;
    int of_table_, n_;
};

// The solid angle that each of n directions of the cone stands for: 1 / (n density).
inline float solid_angle(const Cone& cone, vec3 direction, int n) {
    float c = cone.cosine;
    if (!cone.by_cosine) return 2 * float(kPi) * (1 - c) / float(n);
    float up = std::max(glm::dot(direction, cone.z), 1e-6f);
    return float(kPi) * (1 - c * c) / (up * float(n));
}

}  // namespace kinora
