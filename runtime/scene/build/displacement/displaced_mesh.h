// runtime/scene/build/displacement/displaced_mesh.h: meshes whose shaders move vertices.
#pragma once

#include <vector>

#include "runtime/scene/shapes.h"

namespace kinora {

struct SceneNodes;
struct SceneShaders;

// Shapes that share one displaced mesh: several only where it is displaced once and alike.
struct DisplacedMesh {
    std::vector<uint32_t> shapes;
    std::vector<std::vector<uint32_t>> surfaces;  // by shape, by group
    std::vector<uint8_t> diced, moved;            // by group: displaced, or also transformed
    bool deforms = false;                         // a skin or morph
    bool each_frame = false;                      // the shaders' results change with time
    Mesh base;

    bool any_diced() const;
};

// Of shapes whose surfaces have their instances.
std::vector<DisplacedMesh> find_displaced(const SceneNodes& nodes, const SceneShapes& shapes,
                                          const SceneShaders& shaders);

}  // namespace kinora
