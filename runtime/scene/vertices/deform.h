// runtime/scene/vertices/deform.h: where the vertices of every shape stand at the current values.
#pragma once

#include <span>

#include "runtime/base/math.h"
#include "skin/skin.h"

namespace kinora {

struct Pose;
struct Scene;
struct Shape;
struct ShapePose;

// Joint matrices of the skins whose joints moved.
void pose_joints(const Scene& scene, Pose& pose);

// Morphs, skins, transformations, displacements: only shapes whose joints, weights or node changed
// or whose shaders run at each frame. Also brings the ray tracer's rows up to date (versions,
// instance matrices). Returns the ms that shaders took; counts the vertices moved.
double deform(const Scene& scene, Pose& pose, uint64_t* vertices = nullptr);

// The vertices of a skin (the shape's own, or one with its joints) where its joints are now, by the
// scene's SkinMethod. Spans as for skin::deform.
void move_by_joints(const ShapePose& shape, const skin::SkinMesh& skin,
                    std::span<const vec4> rest_positions, std::span<const vec4> rest_normals,
                    std::span<vec4> positions, std::span<vec4> normals);

// Static shapes into accel space, as Scene::start has them; when the scene's origin is known.
void bake_static(Scene& scene);

// Whether the shape's matrix has no inverse, so that it is not traced (docs/numerics.md#geometry).
bool is_singular(const ShapePose& shape);

}  // namespace kinora
