// runtime/scene/gltf/import/materials.h: glTF's materials as gltf_pbr and gltf_unlit.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "runtime/scene/gltf/import/rsl.h"
#include "runtime/scene/gltf/import/unique_ids.h"

namespace kinora {

class MaterialImporter {
  public:
    MaterialImporter(const tinygltf::Model& model, TextureImporter& textures, RslExtras& rsl,
                     PointerSlots& pointers, GltfReport& report, Diagnostics& diagnostics,
                     SceneDescription& out)
        : model_(model),
          textures_(textures),
          rsl_(rsl),
          pointers_(pointers),
          report_(report),
          diagnostics_(diagnostics),
          out_(out) {}

    // A definition for each material, and a last one for primitives without one.
    void import_materials(UniqueIds& ids);

    // What RSL shaders of a material read of the vertices.
    std::span<const VertexBinding> vertex_inputs(uint32_t material) const {
        return inputs_[material];
    }

  private:
    void import_material(uint32_t index, UniqueIds& ids);
    ShaderUse shader_of(const tinygltf::Material& from, const std::string& pointer);
    void set_base(const tinygltf::Material& from, const std::string& pointer, ShaderUse& use);
    void set_metal(const tinygltf::Material& from, const std::string& pointer, ShaderUse& use);
    void set_lit(const tinygltf::Material& from, const std::string& pointer, ShaderUse& use);
    void set_emission(const tinygltf::Material& from, const std::string& pointer, ShaderUse& use);
    void set_reflection(const tinygltf::Material& from, const std::string& pointer, ShaderUse& use);
    ValueSlot set_one(ShaderUse& use, const char* name, double value);
    void set_followed(ShaderUse& use, const char* name, double value, const std::string& pointer);

    const tinygltf::Model& model_;
    TextureImporter& textures_;
    RslExtras& rsl_;
    PointerSlots& pointers_;
    GltfReport& report_;
    Diagnostics& diagnostics_;
    SceneDescription& out_;
    std::vector<std::vector<VertexBinding>> inputs_;  // per definition
};

}  // namespace kinora
