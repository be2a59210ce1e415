// runtime/scene/gltf/export/common_surface.cpp: fixed-function materials as pbrMetallicRoughness.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/scene/gltf/export/surfaces.h"

namespace kinora {

namespace {

constexpr const char* kModels[] = {"collada_constant", "collada_lambert", "collada_phong",
                                   "collada_blinn"};

double mean(const dvec3& c) {
    return (c.x + c.y + c.z) / 3;
}

// GGX as wide as a Blinn highlight of this exponent (export.h).
double roughness(double exponent) {
    return clamp01(std::sqrt(std::sqrt(2 / (std::max(exponent, 0.0) + 2))));
}

// collada_*.sl, slot_opacity: how much of what lies behind is hidden.
struct Opacity {
    double alpha = 1;  // 0..1
    bool blends = false;
    bool lost_map = false;  // a transparency texture other than the color's alpha
};

Opacity common_opacity(const UsedParams& p, const std::string& base_slot) {
    Opacity result;
    std::string opaque = p.text("opaque");
    bool by_alpha = opaque == "A_ONE" || opaque == "A_ZERO";
    double alpha = 1;
    if (opaque != "NONE" && !opaque.empty()) {
        alpha = p.number("transparency", 1) *
                (by_alpha ? p.number("transparent_alpha", 1) : mean(p.color("transparent", 1)));
        if (opaque.ends_with("ZERO")) alpha = 1 - alpha;
    }
    result.blends = clamp01(alpha) < 1;
    if (std::string t = p.text("transparent_map"); !t.empty() && opaque != "NONE") {
        bool same =
            parse_texture_name(t).path == parse_texture_name(p.text(base_slot + "_map")).path;
        result.blends = same && opaque == "A_ONE";
        result.lost_map = !result.blends;
        alpha = result.blends ? p.number("transparency", 1) : 1;
    }
    result.alpha = clamp01(alpha);
    return result;
}

// Where the first parameter that has a location stands.
Location location_of(const ShaderUse& use) {
    for (const ParamSource& p : use.params)
        if (p.where.file != kNoFile) return p.where;
    return {};
}

Json clamped_color(const dvec3& c) {
    return {clamp01(c.x), clamp01(c.y), clamp01(c.z)};
}

}  // namespace

bool is_common_surface(const ShaderUse& shader) {
    return std::any_of(std::begin(kModels), std::end(kModels),
                       [&](auto* model) { return is_library_shader(shader, model); });
}

Json SurfaceWriter::common(const MaterialDefinition& definition, const UsedParams& p,
                           const MaterialUse& use, const PrimitiveGroup& group) {
    const ShaderUse& shader = p.use;
    std::string model = shader.shader->name;
    bool unlit = model == kModels[0];
    bool has_highlight = model == kModels[2] || model == kModels[3];
    std::string base_slot = unlit ? "emission" : "diffuse";
    dvec3 base = p.color(base_slot, 0);
    Json pbr = {{"metallicFactor", 0}}, material = Json::object();
    if (Json info = map_info(shader, base_slot, use, group); !info.is_null()) {
        pbr["baseColorTexture"] = info;
        base = dvec3(1.0);
    }
    Opacity opacity = common_opacity(p, base_slot);
    if (opacity.lost_map)
        losses_.lost(fmt::format("material '{}'", definition.id),
                     "a transparency texture other than the color's alpha", location_of(shader));
    if (opacity.blends) material["alphaMode"] = "BLEND";
    pbr["baseColorFactor"] = clamped_color(base);
    pbr["baseColorFactor"].push_back(opacity.alpha);
    dvec3 specular = p.color("specular", 0);
    double most = std::max({specular.x, specular.y, specular.z});
    bool shines = has_highlight && most > 0;
    // Phong's lobe around R is a Blinn lobe around the half vector of four times the exponent.
    double exponent = (model == kModels[2] ? 4 : 1) * p.number("shininess", 20);
    pbr["roughnessFactor"] = shines ? roughness(exponent) : 1.0;
    material["pbrMetallicRoughness"] = pbr;
    if (unlit) {
        extend(material, "KHR_materials_unlit", Json::object());
        return material;
    }
    Json layer = {{"specularFactor", has_highlight ? clamp01(most) : 0.0}};
    if (shines) layer["specularColorFactor"] = clamped_color(specular / most);
    extend(material, "KHR_materials_specular", layer);
    if (!shines) extend(material, "KHR_materials_ior", {{"ior", 1.0}});
    dvec3 emission = p.color("emission", 0);
    bool of_body = p.number("emission_of_body", 0) != 0;  // a factor of what lights meet
    if (of_body && pbr.contains("baseColorTexture"))
        material["emissiveTexture"] = pbr["baseColorTexture"];
    else if (of_body)
        emission *= base;
    if (Json info = map_info(shader, "emission", use, group); !info.is_null()) {
        material["emissiveTexture"] = info;
        emission = dvec3(1.0);
    }
    if (emission != dvec3(0.0)) material["emissiveFactor"] = clamped_color(emission);
    return material;
}

}  // namespace kinora
