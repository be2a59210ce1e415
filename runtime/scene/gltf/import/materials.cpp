// runtime/scene/gltf/import/materials.cpp: glTF's materials as gltf_pbr and gltf_unlit.
#include "runtime/scene/gltf/import/materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/gltf/file/value.h"
#include "runtime/scene/gltf/import/specular_glossiness.h"
#include "runtime/scene/gltf/import/values.h"

namespace kinora {

namespace {

constexpr const char* kBaseColor = "/pbrMetallicRoughness/baseColorFactor";
constexpr const char* kMetal = "/pbrMetallicRoughness/metallicFactor";
constexpr const char* kRoughness = "/pbrMetallicRoughness/roughnessFactor";
constexpr const char* kMetalValues[] = {kBaseColor, kMetal, kRoughness};

// A number of an extension's object, or `otherwise`.
double extension_number(const tinygltf::ExtensionMap& extensions, const char* extension,
                        const char* name, double otherwise) {
    auto found = extensions.find(extension);
    if (found == extensions.end()) return otherwise;
    return number_member(found->second, name).value_or(otherwise);
}

std::vector<double> extension_color(const tinygltf::ExtensionMap& extensions, const char* extension,
                                    const char* name) {
    std::vector<double> color(3, 1.0);
    auto found = extensions.find(extension);
    if (found == extensions.end() || !found->second.Has(name)) return color;
    const tinygltf::Value& value = found->second.Get(name);
    for (size_t k = 0; k < 3 && value.IsArray() && k < value.ArrayLen(); ++k)
        if (value.Get(int(k)).IsNumber() && std::isfinite(value.Get(int(k)).GetNumberAsDouble()))
            color[k] = std::max(value.Get(int(k)).GetNumberAsDouble(), 0.0);
    return color;
}

// The first `count` of a factor, each within [0, most]; missing and not finite ones are
// `otherwise`.
std::vector<double> factor(const std::vector<double>& numbers, size_t count, double otherwise) {
    std::vector<double> result(count, otherwise);
    for (size_t k = 0; k < count && k < numbers.size(); ++k)
        if (std::isfinite(numbers[k])) result[k] = std::max(numbers[k], 0.0);
    return result;
}

// KHR_materials_ior; an ior of 0 reflects all.
double reflectance(double ior) {
    double r = (ior - 1) / (ior + 1);
    return r * r;
}

// Of tinygltf's TextureInfo, NormalTextureInfo or OcclusionTextureInfo.
template <class T>
GltfTextureInfo info_of(const T& info) {
    return {info.index, info.texCoord, info.extensions};
}

}  // namespace

void MaterialImporter::import_materials(UniqueIds& ids) {
    inputs_.resize(model_.materials.size() + 1);
    for (uint32_t m = 0; m < model_.materials.size(); ++m) import_material(m, ids);
    // What primitives without a material wear (glTF 2.0, 3.9.6): all defaults.
    bool worn = false;
    for (const tinygltf::Mesh& mesh : model_.meshes)
        for (const tinygltf::Primitive& primitive : mesh.primitives)
            worn |= primitive.material < 0 || size_t(primitive.material) >= model_.materials.size();
    if (!worn) return;
    MaterialDefinition& plain = out_.materials.emplace_back();
    plain.id = ids.id("default material", "material", model_.materials.size());
    plain.name = "default material";
    plain.hide_backfaces = true;
    plain.surfaces.push_back({library_shader("gltf_pbr"), {}});
}

void MaterialImporter::import_material(uint32_t index, UniqueIds& ids) {
    const tinygltf::Material& from = model_.materials[index];
    std::string pointer = fmt::format("/materials/{}", index);
    MaterialDefinition& to = out_.materials.emplace_back();
    to.name = from.name;
    to.id = ids.id(from.name, "material", index);
    to.hide_backfaces = !from.doubleSided;
    const size_t first = pointers_.followers().size();
    to.surfaces.push_back(shader_of(from, pointer));
    const size_t end = pointers_.followers().size();
    const tinygltf::Value* rsl = member(from.extras, "kinora_rsl");
    if (!rsl) return;
    const ShaderUse* own = to.surfaces.data();
    inputs_[index] = rsl_.import_material(*rsl, pointer + "/extras/kinora_rsl", to);
    if (to.surfaces.data() != own) pointers_.pass_over_from(first, end);  // another list
}

ValueSlot MaterialImporter::set_one(ShaderUse& use, const char* name, double value) {
    return set_number(use, name, std::span(&value, 1), out_.values);
}

// A number that is the file's at the pointer.
void MaterialImporter::set_followed(ShaderUse& use, const char* name, double value,
                                    const std::string& pointer) {
    pointers_.follow({pointer, {value}}, {set_one(use, name, value)});
}

ShaderUse MaterialImporter::shader_of(const tinygltf::Material& from, const std::string& pointer) {
    bool unlit = from.extensions.contains("KHR_materials_unlit");
    ShaderUse use;
    use.shader = library_shader(unlit ? "gltf_unlit" : "gltf_pbr");
    auto glossy = from.extensions.find(kSpecularGlossiness);
    bool is_glossy = glossy != from.extensions.end();
    std::string own = pointer + "/extensions/" + kSpecularGlossiness;
    if (is_glossy)
        set_diffuse_base(glossy->second, own, textures_, pointers_, use, out_.values);
    else
        set_base(from, pointer, use);
    set_string(use, "alpha_mode", from.alphaMode);
    set_followed(use, "alpha_cutoff", std::isfinite(from.alphaCutoff) ? from.alphaCutoff : 0.5,
                 pointer + "/alphaCutoff");
    if (unlit) return use;
    // A flag, not the roughness itself: what decides the control flow makes a kernel of its own.
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    bool mirrors = pbr.roughnessFactor < 0.5 || pbr.metallicRoughnessTexture.index >= 0 ||
                   pointers_.is_driven(pointer + kRoughness);
    if (is_glossy) {
        for (const char* value : kMetalValues) pointers_.pass_over(pointer + value);
        mirrors =
            set_specular_glossiness(glossy->second, own, textures_, pointers_, use, out_.values);
    } else {
        set_metal(from, pointer, use);
    }
    set_lit(from, pointer, use);
    if (!is_glossy) set_reflection(from, pointer, use);
    set_one(use, "mirrors", mirrors);
    return use;
}

void MaterialImporter::set_base(const tinygltf::Material& from, const std::string& pointer,
                                ShaderUse& use) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    std::vector<double> base = factor(pbr.baseColorFactor, 4, 1.0);
    ValueSlot color = set_number(use, "base_color", std::span(base).first(3), out_.values);
    ValueSlot alpha = set_number(use, "base_alpha", std::span(base).last(1), out_.values);
    pointers_.follow({pointer + kBaseColor, base}, {color, alpha});
    textures_.set_map(use, "base_color", info_of(pbr.baseColorTexture), false,
                      pointer + "/pbrMetallicRoughness/baseColorTexture");
}

void MaterialImporter::set_metal(const tinygltf::Material& from, const std::string& pointer,
                                 ShaderUse& use) {
    const tinygltf::PbrMetallicRoughness& pbr = from.pbrMetallicRoughness;
    set_followed(use, "metallic", factor({pbr.metallicFactor}, 1, 1.0)[0], pointer + kMetal);
    set_followed(use, "roughness", factor({pbr.roughnessFactor}, 1, 1.0)[0], pointer + kRoughness);
    textures_.set_map(use, "metallic_roughness", info_of(pbr.metallicRoughnessTexture), true,
                      pointer + "/pbrMetallicRoughness/metallicRoughnessTexture");
}

void MaterialImporter::set_lit(const tinygltf::Material& from, const std::string& pointer,
                               ShaderUse& use) {
    auto map = [&](const char* name, const auto& info, bool data, const char* of) {
        textures_.set_map(use, name, info_of(info), data, pointer + of);
    };
    set_followed(use, "normal_scale",
                 std::isfinite(from.normalTexture.scale) ? from.normalTexture.scale : 1,
                 pointer + "/normalTexture/scale");
    map("normal", from.normalTexture, true, "/normalTexture");
    set_followed(use, "occlusion_strength", factor({from.occlusionTexture.strength}, 1, 1.0)[0],
                 pointer + "/occlusionTexture/strength");
    map("occlusion", from.occlusionTexture, true, "/occlusionTexture");
    set_emission(from, pointer, use);
    map("emissive", from.emissiveTexture, false, "/emissiveTexture");
}

// The factor times KHR_materials_emissive_strength.
void MaterialImporter::set_emission(const tinygltf::Material& from, const std::string& pointer,
                                    ShaderUse& use) {
    constexpr const char* kExtension = "KHR_materials_emissive_strength";
    double strength =
        std::max(extension_number(from.extensions, kExtension, "emissiveStrength", 1.0), 0.0);
    FileValue color{pointer + "/emissiveFactor", factor(from.emissiveFactor, 3, 0.0)};
    std::vector<double> emissive = color.rest;
    for (double& e : emissive) e *= strength;
    ValueSlot slot = set_number(use, "emissive", emissive, out_.values);
    FileValue times{fmt::format("{}/extensions/{}/emissiveStrength", pointer, kExtension),
                    {strength}};
    if (!pointers_.is_driven(times.pointer))
        return pointers_.follow(std::move(color), {slot}, strength);
    pointers_.follow({std::move(color), std::move(times)}, {slot},
                     [](auto values, double* numbers) {
                         for (size_t k = 0; k < 3; ++k) numbers[k] = values[0][k] * values[1][0];
                     });
}

// KHR_materials_ior and KHR_materials_specular.
void MaterialImporter::set_reflection(const tinygltf::Material& from, const std::string& pointer,
                                      ShaderUse& use) {
    double ior = extension_number(from.extensions, "KHR_materials_ior", "ior", 1.5);
    ValueSlot reflected = set_one(use, "dielectric_F0", reflectance(ior));
    pointers_.follow({{pointer + "/extensions/KHR_materials_ior/ior", {ior}}}, {reflected},
                     [](auto values, double* number) { *number = reflectance(values[0][0]); });
    constexpr const char* kSpecular = "KHR_materials_specular";
    std::string own = fmt::format("{}/extensions/{}/", pointer, kSpecular);
    set_followed(use, "specular",
                 extension_number(from.extensions, kSpecular, "specularFactor", 1.0),
                 own + "specularFactor");
    std::vector<double> tint = extension_color(from.extensions, kSpecular, "specularColorFactor");
    pointers_.follow({own + "specularColorFactor", tint},
                     {set_number(use, "specular_color", tint, out_.values)});
    auto found = from.extensions.find(kSpecular);
    if (found != from.extensions.end() &&
        (found->second.Has("specularTexture") || found->second.Has("specularColorTexture")))
        report_.add(Code::GLTF_VALUE, pointer + "/extensions/" + kSpecular,
                    "the textures of KHR_materials_specular are left out");
}

}  // namespace kinora
