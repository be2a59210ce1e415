// runtime/scene/gltf/import/specular_glossiness.h: KHR_materials_pbrSpecularGlossiness as gltf_pbr.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/gltf/import/textures.h"

namespace kinora {

inline constexpr const char* kSpecularGlossiness = "KHR_materials_pbrSpecularGlossiness";

// Gives a use of gltf_pbr or gltf_unlit the base color of the extension's object with its texture,
// which stand in place of those of pbrMetallicRoughness.
void set_diffuse_base(const tinygltf::Value& extension, const std::string& pointer,
                      TextureImporter& textures, PointerSlots& pointers, ShaderUse& use,
                      std::vector<double>& values);

// Gives a use of gltf_pbr what the extension says of reflection: no metal, the specular color as
// the reflectance face-on, a roughness of 1 - glossiness. Returns whether it mirrors.
bool set_specular_glossiness(const tinygltf::Value& extension, const std::string& pointer,
                             TextureImporter& textures, PointerSlots& pointers, ShaderUse& use,
                             std::vector<double>& values);

}  // namespace kinora
