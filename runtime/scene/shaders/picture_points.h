// runtime/scene/shaders/picture_points.h: points of a picture that ask about what they lie on, and
// how they are seen.
#pragma once

#include <span>

#include "raytrace/wavefront.h"
#include "runtime/base/math.h"

namespace kinora {

struct Pose;
struct SceneShapes;
struct ShaderInstance;

inline constexpr size_t kGridPoints = 1024;  // one grid at most; its columns stay in the L2 cache

// rayinfo("type") of the points that a ray sees.
enum class RayType : uint8_t { Camera, Specular, Diffuse, Transmission };

// How the rays came about that see a grid's points.
struct RayTag {
    RayType type = RayType::Camera;
    int32_t label = 0;                   // interned; of trace or gather
    uint32_t specular = 0, diffuse = 0;  // rays of each type on the way from the eye
    uint32_t counted = 0;    // lamps whose light the sender gets from them: ShadingFrame::counted
    bool scattered = false;  // some ray on the way was one of many, in many directions
    uint32_t most_samples = 0;  // that a call takes there, --samples-behind; 0: all it asks for

    bool operator==(const RayTag&) const = default;
};

// Where a frame is seen from: "current" space.
struct EyeSpace {
    mat3 camera_from_accel{1.0f};
    vec3 eye{0.0f};  // accel space
};

// The points of some hits that wear one look.
struct PicturePoints {
    const EyeSpace& space;
    const raytrace::HitBatch& hits;
    std::span<const uint32_t> points;  // indices into hits
    const ShaderInstance* look;
    uint32_t depth = 0;
    RayTag ray = {};
    // By Column: rows of padded(count) floats; null where nobody asked. "current" space.
    std::span<float*> columns = {};
    // Whose parameters surface() and displacement() show a light: of the surface it lights; null
    // in lights and volumes: each point's own surface.
    const ShaderInstance* surface = nullptr;
    const PicturePoints* lit = nullptr;  // a light's: those of the surface
    size_t lit_first = 0;                // whose point that of point 0 is
    uint32_t lamp_samples = 0;           // a light's: how many a lamp sends there; 0: no light

    size_t count() const { return points.size(); }
    // A light's are those of the surface that it lights.
    const PicturePoints& of_surface() const { return lit ? *lit : *this; }
};

// Number `component` of ShaderInstance::varying[which] of the look that a hit's surface wears: the
// bits that its column would have.
float varying_at(const SceneShapes& scene, const Pose& pose, const ShaderInstance& look,
                 const raytrace::HitBatch& hits, uint32_t hit, size_t which, uint32_t component);

}  // namespace kinora
