// runtime/scene/build/instances/vertex_instances.h: shader instances that move vertices.
#pragma once

#include <map>
#include <string>

#include "runtime/scene/build/instances/instance_compiler.h"
#include "runtime/scene/build/instances/material_instance.h"
#include "runtime/scene/shaders.h"
#include "runtime/scene/shapes.h"

namespace kinora {

// Writes Scene::vertex_instances.
class VertexInstances {
  public:
    VertexInstances(const SceneDescription& description, const SceneShapes& shapes,
                    SceneShaders& scene, InstanceCompiler& compiler)
        : description_(description), shapes_(shapes), scene_(scene), compiler_(compiler) {}

    // The instance of a material's transformations, or of its displacements, compiled, for a
    // surface: none where the material has none, or where displacements leave P alone (then N is
    // bent while shading). Sets Surface::st and the VertexUse of that kind.
    void add(ShaderInstanceKind kind, Surface& surface, const MaterialUse* use,
             const MaterialDefinition& material);

    bool all_compiled() const { return all_compiled_; }

  private:
    uint32_t find_or_compile(KeyedInstance made);

    const SceneDescription& description_;
    const SceneShapes& shapes_;
    SceneShaders& scene_;
    InstanceCompiler& compiler_;
    std::map<std::string, uint32_t> by_key_;  // kNone: it leaves P alone
    bool all_compiled_ = true;
};

}  // namespace kinora
