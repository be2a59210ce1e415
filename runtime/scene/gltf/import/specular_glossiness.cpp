// runtime/scene/gltf/import/specular_glossiness.cpp: KHR_materials_pbrSpecularGlossiness as
// gltf_pbr.
#include "runtime/scene/gltf/import/specular_glossiness.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "runtime/scene/gltf/file/value.h"
#include "runtime/scene/gltf/import/values.h"

namespace kinora {

namespace {

// The numbers of a factor, each within [0, 1]; 1 where the file has none.
std::vector<double> factor(const tinygltf::Value& extension, const char* name, size_t count) {
    std::vector<double> given, result(count, 1.0);
    if (const tinygltf::Value* value = member(extension, name)) append_numbers(*value, given);
    for (size_t k = 0; k < std::min(count, given.size()); ++k)
        if (std::isfinite(given[k])) result[k] = std::clamp(given[k], 0.0, 1.0);
    return result;
}

int index_member(const tinygltf::Value& object, const char* name, int otherwise) {
    constexpr int kBeyond = std::numeric_limits<int>::max();
    double index = number_member(object, name).value_or(otherwise);
    return index >= -1 && index < kBeyond ? int(index) : kBeyond;
}

bool set_texture(const tinygltf::Value& extension, const char* name, const char* slot,
                 const std::string& pointer, TextureImporter& textures, ShaderUse& use) {
    const tinygltf::Value* info = member(extension, name);
    if (!info) return false;
    tinygltf::ExtensionMap extensions;
    if (const tinygltf::Value* own = member(*info, "extensions"))
        for (const std::string& key : member_names(*own)) extensions[key] = own->Get(key);
    GltfTextureInfo texture{index_member(*info, "index", -1), index_member(*info, "texCoord", 0),
                            extensions};
    textures.set_map(use, slot, texture, false, pointer + "/" + name);
    return true;
}

}  // namespace

void set_diffuse_base(const tinygltf::Value& extension, const std::string& pointer,
                      TextureImporter& textures, PointerSlots& pointers, ShaderUse& use,
                      std::vector<double>& values) {
    std::vector<double> diffuse = factor(extension, "diffuseFactor", 4);
    ValueSlot color = set_number(use, "base_color", std::span(diffuse).first(3), values);
    ValueSlot alpha = set_number(use, "base_alpha", std::span(diffuse).last(1), values);
    pointers.follow({pointer + "/diffuseFactor", diffuse}, {color, alpha});
    set_texture(extension, "diffuseTexture", "base_color", pointer, textures, use);
}

bool set_specular_glossiness(const tinygltf::Value& extension, const std::string& pointer,
                             TextureImporter& textures, PointerSlots& pointers, ShaderUse& use,
                             std::vector<double>& values) {
    auto set_one = [&](const char* name, double value) {
        return set_number(use, name, std::span(&value, 1), values);
    };
    double glossiness = factor(extension, "glossinessFactor", 1)[0];
    set_one("metallic", 0);
    const FileValue gloss{pointer + "/glossinessFactor", {glossiness}};
    pointers.follow({gloss}, {set_one("roughness", 1 - glossiness)},
                    [](auto given, double* roughness) { *roughness = 1 - given[0][0]; });
    set_one("specular_glossiness", 1);
    set_one("dielectric_F0", 1);  // times the specular color
    std::vector<double> specular = factor(extension, "specularFactor", 3);
    pointers.follow({pointer + "/specularFactor", specular},
                    {set_number(use, "specular_color", specular, values)});
    bool mapped = set_texture(extension, "specularGlossinessTexture", "specular_glossiness",
                              pointer, textures, use);
    return mapped || glossiness > 0.5 || pointers.is_driven(gloss.pointer);
}

}  // namespace kinora
