// runtime/scene/build/instances/material_instance.h: a material's shaders as a shader instance.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

// Puts the parameters that instance_material binds over those of the layers; `key` gets what tells
// them apart from other binds. No use: no binds.
void apply_binds(const SceneDescription& description, const MaterialUse* use,
                 std::vector<ShaderUse>& layers, std::string& key);

// An instance to be compiled. Those with the same key are the same instance.
struct KeyedInstance {
    std::unique_ptr<ShaderInstance> instance;
    std::string key;
};

// Of shaders of the material, with the use's binds over them, on node `node`.
KeyedInstance begin_instance(const SceneDescription& description, ShaderInstanceKind kind,
                             const MaterialDefinition& material, std::vector<ShaderUse> layers,
                             const MaterialUse* use, uint32_t node);

// The part of the key that the instance's varying parameters are: surfaces that share an instance
// have the same list of them.
std::string varying_key(const ShaderInstance& instance);

}  // namespace kinora
