// runtime/scene/build/shapes/skins.h: joints and influences of the shapes that a skin or morph
// deforms.
#pragma once

#include <span>
#include <vector>

#include "runtime/base/skin_space.h"
#include "runtime/scene/build/shapes/node_tree.h"
#include "runtime/scene/vertices/diced_mesh.h"

namespace kinora {

// World matrices of all nodes as the file leaves them and at the first keys, whatever is played.
struct NodePoses {
    std::vector<dmat4> rest, start;
};

// Nothing where there are no skins. The scene stands at another time afterwards.
NodePoses node_poses(const SceneNodes& scene, Pose& start);

// Reads Scene::nodes; writes what Shape has of its skin.
class SkinBinder {
  public:
    SkinBinder(const SceneNodes& scene, const NodeTree& tree, NodePoses poses,
               Diagnostics& diagnostics);

    // The shape has its node and conversion.
    void bind(const MeshUse& use, const Mesh& mesh, Shape& shape) const;

  private:
    void bind_joints(const MeshUse& use, Shape& shape) const;
    void convert_binds(Shape& shape) const;
    void choose_space(const SkinDefinition& skin, Shape& shape) const;
    SkinPose pose_of(const Shape& shape, std::span<const dmat4> world, uint32_t shared) const;

    const SceneNodes& scene_;
    const NodeTree& tree_;
    NodePoses poses_;
    Diagnostics& diagnostics_;
};

// The influences of a mesh: as the file has them, or between its vertices where the mesh was diced
// (`stencils` are not null); only as many a vertex as the scene's options allow.
skin::SkinMesh skin_mesh_of(const SceneResources& scene, const MeshUse& use, size_t vertices,
                            std::span<const uint32_t> normal_positions,
                            const std::vector<Stencil>* stencils, skin::SkinRepairs& repairs);

}  // namespace kinora
