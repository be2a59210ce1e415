// runtime/scene/vertices/dice_error.h: whether displaced meshes are diced finely enough for the
// camera as it stands, whatever views they were diced for.
#pragma once

#include <span>
#include <vector>

#include "runtime/scene/vertices/diced_mesh.h"
#include "skin/morph.h"
#include "skin/skin.h"

namespace kinora {

struct Pose;
struct SceneExtent;

// Edges of a diced mesh where they would be undisplaced, which is how dicing measures them: the
// longest one of each triangle, or of some that lie together where there are many.
struct WatchedEdges {
    std::vector<uint32_t> shapes;  // that wear the mesh
    dvec3 anchor{0.0};
    // Minus the anchor: the ends of the edges in pairs; where the shape deforms, vertices of the
    // mesh before it was diced.
    std::vector<vec4> rest;

    // Where the shape deforms:
    std::vector<Stencil> vertices;  // what `rest` is of the mesh before it was diced
    std::vector<Stencil> ends;      // of `rest`, in pairs
    skin::SkinMesh skin;
    skin::Morph morph;
    bool deforms() const { return skin.joint_count > 0; }
};

// Chooses the edges of a mesh that was diced, before its vertices are moved. `diced` marks the
// groups that were, `world` is world_from_mesh without its translation, `triangles` counts those of
// all meshes that are watched: the edges of all are some 20 000 at most, unless triangles that
// follow each other lie apart. Fewer would miss the few triangles of a coarse mesh that are seen.
void choose_edges(const Mesh& base, const DicedMesh& made, std::span<const uint8_t> diced,
                  const dmat3& world, bool deforms, size_t triangles, WatchedEdges& out);

// The longest watched edge, in pixels of the pose's view, over what none is longer than where the
// mesh was diced for that view: 1 or less then, 2 where the camera is twice as near. 0 where
// nothing was diced. The nodes, joints (`pose_joints`) and the camera (`set_view`) are up to date.
// No allocation.
double dice_error(const SceneDescription& description, const SceneShapes& scene, Pose& pose);

// Accel space from a mesh's positions minus `anchor`, as the shape's node stands.
dmat4 accel_from_rest(const SceneExtent& scene, const Pose& pose, const Shape& shape, dvec3 anchor);

}  // namespace kinora
