// runtime/picture/shading/rays/smooth_surface.h: the surface that vertex normals describe.
#pragma once

#include <cstdint>
#include <span>

#include "raytrace/accel.h"
#include "raytrace/wavefront.h"
#include "runtime/base/math.h"

namespace kinora {

struct Pose;
struct SceneShapes;

// The cosine between facet and light above which a facet is not left.
inline constexpr float kSeesLight = 0.1f;

// The smooth surface that the normals of triangles describe, for rays to lights: a facet that looks
// away from a light which that surface sees would shade itself, in black blocks (J. Hanika, Hacking
// the Shadow Terminator, Ray Tracing Gems II, 2021).
class SmoothSurface {
  public:
    SmoothSurface(const SceneShapes& shapes, const Pose& pose) : shapes_(shapes), pose_(pose) {}
    // From a hit to that surface; accel space. 0 where the facet sees the light or is shaded on
    // both accounts, where it is flat, and where the surface is hollow.
    vec3 way_from(const raytrace::HitBatch& hits, uint32_t hit, vec3 to_light);
    // How its unit normal on the side that the hit's ray came from turns over the hit's footprint,
    // a pixel in x and in y. False where it is flat.
    bool bend_at(const raytrace::HitBatch& hits, uint32_t hit, vec3& dNdx, vec3& dNdy);

  private:
    // What a row of the scene has for its normals.
    struct Row {
        uint32_t number = raytrace::kNone;
        std::span<const uint32_t> normal_corners, triangles;
        std::span<const vec4> normals, positions;
        mat3 from_rest{1.0f}, normals_from_rest{1.0f};
    };
    void enter(uint32_t row);
    const uint32_t* corners(uint32_t primitive) const;

    const SceneShapes& shapes_;
    const Pose& pose_;
    Row row_;
};

// Whether nothing stands on that way from a facet to its smooth surface.
bool is_way_free(const raytrace::Accel& accel, vec3 P, vec3 error, vec3 Ng, vec3 way,
                 raytrace::TraceCounters& counters);

}  // namespace kinora
