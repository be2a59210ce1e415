// runtime/gltf/export/materials.cpp: fixed-function materials as pbrMetallicRoughness.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/description/findings.h"
#include "runtime/gltf/export/export_p.h"

namespace kinora {

namespace {

constexpr const char* kModels[] = {"collada_constant", "collada_lambert", "collada_phong",
                                   "collada_blinn"};

double mean(const dvec3& c) {
    return (c.x + c.y + c.z) / 3;
}

double clamp01(double x) {
    return std::clamp(std::isfinite(x) ? x : 0.0, 0.0, 1.0);
}

// GGX as wide as a Blinn highlight of this exponent (export.h).
double roughness(double exponent) {
    return clamp01(std::sqrt(std::sqrt(2 / (std::max(exponent, 0.0) + 2))));
}

}  // namespace

Json GltfExport::texture_info(const std::string& name, const ParamSource& source,
                              const MaterialUse& use, const PrimitiveGroup& group) {
    uint32_t index = texture(name);
    if (index == kNone) return nullptr;
    Json info = {{"index", index}};
    if (uint32_t set = texcoord_index(source.texcoord, use, group)) info["texCoord"] = set;
    std::array<float, 4> uv = parse_texture_name(name).uv;
    if (uv != std::array<float, 4>{1, 1, 0, 0}) {
        // s' = s a + c, t' = t b + d with t = 1 - v.
        Json transform = {{"offset", {uv[2], 1 - uv[1] - uv[3]}}, {"scale", {uv[0], uv[1]}}};
        info["extensions"]["KHR_texture_transform"] = transform;
        use_extension("KHR_texture_transform");
    }
    return info;
}

// Which TEXCOORD_n a texcoord name means on this group: by the instance's vertex bindings, else the
// lowest set.
uint32_t GltfExport::texcoord_index(const std::string& name, const MaterialUse& use,
                                    const PrimitiveGroup& group) const {
    std::vector<uint32_t> sets;
    for (const VertexAttribute& a : group.attributes)
        if (a.semantic == "TEXCOORD" && a.stride >= 2) sets.push_back(a.set);
    std::sort(sets.begin(), sets.end());
    for (const VertexBinding& b : use.vertex_bindings) {
        if (b.param != name || b.semantic != "TEXCOORD" || b.set == kNone) continue;
        auto found = std::find(sets.begin(), sets.end(), b.set);
        if (found != sets.end()) return uint32_t(found - sets.begin());
    }
    return 0;
}

namespace {

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

Json clamped(const dvec3& c) {
    return {clamp01(c.x), clamp01(c.y), clamp01(c.z)};
}

}  // namespace

Json GltfExport::common_material(const MaterialDefinition& definition, const ShaderUse& shader,
                                 const MaterialUse& use, const PrimitiveGroup& group) {
    UsedParams p{shader, description_.values};
    std::string model = shader.shader->name;
    bool unlit = model == kModels[0];
    bool has_highlight = model == kModels[2] || model == kModels[3];
    std::string base_slot = unlit ? "emission" : "diffuse";
    dvec3 base = p.color(base_slot, 0);
    Json pbr = {{"metallicFactor", 0}}, material = Json::object();
    auto map = [&](const std::string& slot) -> Json {
        const ParamSource* source = find_source(shader, slot + "_map");
        if (!source || source->strings.empty() || source->strings[0].empty()) return nullptr;
        return texture_info(source->strings[0], *source, use, group);
    };
    if (Json info = map(base_slot); !info.is_null()) {
        pbr["baseColorTexture"] = info;
        base = dvec3(1.0);
    }
    Opacity opacity = common_opacity(p, base_slot);
    if (opacity.lost_map)
        lost(fmt::format("material '{}'", definition.id),
             "a transparency texture other than the color's alpha", material_place(shader));
    if (opacity.blends) material["alphaMode"] = "BLEND";
    pbr["baseColorFactor"] = clamped(base);
    pbr["baseColorFactor"].push_back(opacity.alpha);
    dvec3 specular = p.color("specular", 0);
    double most = std::max({specular.x, specular.y, specular.z});
    bool shines = has_highlight && most > 0;
    // Phong's lobe around R is a Blinn lobe around the half vector of four times the exponent.
    double exponent = (model == kModels[2] ? 4 : 1) * p.number("shininess", 20);
    pbr["roughnessFactor"] = shines ? roughness(exponent) : 1.0;
    material["pbrMetallicRoughness"] = pbr;
    if (unlit) {
        material["extensions"]["KHR_materials_unlit"] = Json::object();
        use_extension("KHR_materials_unlit");
        return material;
    }
    Json layer = {{"specularFactor", has_highlight ? clamp01(most) : 0.0}};
    if (shines) layer["specularColorFactor"] = clamped(specular / most);
    material["extensions"]["KHR_materials_specular"] = layer;
    use_extension("KHR_materials_specular");
    if (!shines) {
        material["extensions"]["KHR_materials_ior"] = {{"ior", 1.0}};
        use_extension("KHR_materials_ior");
    }
    dvec3 emission = p.color("emission", 0);
    if (Json info = map("emission"); !info.is_null()) {
        material["emissiveTexture"] = info;
        emission = dvec3(1.0);
    }
    if (emission != dvec3(0.0)) material["emissiveFactor"] = clamped(emission);
    return material;
}

namespace {

// KHR_texture_transform from the rows that import_gltf_texture makes of it: uv' = offset +
// R(rotation) (scale uv) in s = u, t = 1 - v. Null for the identity; `is_all` false where the
// rows are no such transform.
Json texture_transform(const UsedParams& p, const std::string& slot, bool& is_all) {
    auto row = [&](const char* name, double otherwise) { return p.number(slot + name, otherwise); };
    double ss = row("_ss", 1), st = row("_st", 0), so = row("_so", 0);
    double ts = row("_ts", 0), tt = row("_tt", 1), to = row("_to", 0);
    double sx = std::hypot(ss, ts), sy = std::hypot(st, tt);
    if (ss * tt - st * ts < 0) sy = -sy;
    double angle = sx > 0 ? std::atan2(ts, ss) : std::atan2(-st, tt);
    double off = std::abs(st + std::sin(angle) * sy) + std::abs(tt - std::cos(angle) * sy);
    is_all &= off <= 1e-6 * (sx + std::abs(sy));
    Json transform = Json::object();
    double ox = so + st, oy = 1 - tt - to;
    if (ox != 0 || oy != 0) transform["offset"] = {ox, oy};
    if (angle != 0) transform["rotation"] = angle;
    if (sx != 1 || sy != 1) transform["scale"] = {sx, sy};
    return transform.empty() ? Json() : transform;
}

}  // namespace

// What import_gltf makes of glTF's own materials, written back; `is_all` false where they say more
// than glTF does.
Json GltfExport::pbr_material(const ShaderUse& shader, const MaterialUse& use,
                              const PrimitiveGroup& group, bool& is_all) {
    UsedParams p{shader, description_.values};
    is_all = use.params.empty();
    auto unit = [&](double x) {
        is_all &= x >= 0 && x <= 1;
        return clamp01(x);
    };
    dvec3 base = p.color("base_color", 1), emissive = p.color("emissive", 0);
    Json pbr = {{"baseColorFactor",
                 {unit(base.x), unit(base.y), unit(base.z), unit(p.number("base_alpha", 1))}}};
    Json material = Json::object();
    auto extend = [&](const char* extension, Json value) {
        material["extensions"][extension] = std::move(value);
        use_extension(extension);
    };
    auto map = [&](const std::string& slot, bool data) -> Json {
        const ParamSource* source = find_source(shader, slot + "_map");
        if (!source || source->strings.empty() || source->strings[0].empty()) return nullptr;
        Json info = texture_info(source->strings[0], *source, use, group);
        TextureName look = parse_texture_name(source->strings[0]);
        Json transform = texture_transform(p, slot, is_all);
        bool placed_twice = !transform.is_null() && look.uv != TextureName().uv;
        is_all &= fits_gltf_sampler(look) && look.data == data && !placed_twice;
        if (info.is_null() || transform.is_null() || placed_twice) return info;
        info["extensions"]["KHR_texture_transform"] = transform;
        use_extension("KHR_texture_transform");
        return info;
    };
    auto set = [](Json& place, const char* name, Json info) {
        if (!info.is_null()) place[name] = std::move(info);
    };
    set(pbr, "baseColorTexture", map("base_color", false));
    if (shader.shader->name == "gltf_unlit") {
        extend("KHR_materials_unlit", Json::object());
    } else {
        pbr["metallicFactor"] = unit(p.number("metallic", 1));
        pbr["roughnessFactor"] = unit(p.number("roughness", 1));
        set(pbr, "metallicRoughnessTexture", map("metallic_roughness", true));
        if (Json info = map("normal", true); !info.is_null()) {
            info["scale"] = p.number("normal_scale", 1);
            material["normalTexture"] = info;
        }
        if (Json info = map("occlusion", true); !info.is_null()) {
            info["strength"] = unit(p.number("occlusion_strength", 1));
            material["occlusionTexture"] = info;
        }
        set(material, "emissiveTexture", map("emissive", false));
        double most = std::max({emissive.x, emissive.y, emissive.z, 1.0});
        if (emissive != dvec3(0.0))
            material["emissiveFactor"] = {emissive.x / most, emissive.y / most, emissive.z / most};
        if (most > 1) extend("KHR_materials_emissive_strength", {{"emissiveStrength", most}});
        // KHR_materials_ior: an ior of 0 reflects all.
        double r = std::sqrt(unit(p.number("dielectric_F0", 0.04)));
        if (std::abs(r - 0.2) > 1e-9)
            extend("KHR_materials_ior", {{"ior", r < 1 ? (1 + r) / (1 - r) : 0.0}});
        dvec3 tint = p.color("specular_color", 1);
        double specular = p.number("specular", 1);
        if (specular != 1 || tint != dvec3(1.0))
            extend("KHR_materials_specular",
                   {{"specularFactor", unit(specular)},
                    {"specularColorFactor",
                     {std::max(tint.x, 0.0), std::max(tint.y, 0.0), std::max(tint.z, 0.0)}}});
    }
    material["pbrMetallicRoughness"] = pbr;
    std::string mode = p.text("alpha_mode");
    if (mode == "BLEND" || mode == "MASK") material["alphaMode"] = mode;
    if (mode == "MASK") material["alphaCutoff"] = std::max(p.number("alpha_cutoff", 0.5), 0.0);
    return material;
}

uint32_t GltfExport::material(const MeshUse& use, const PrimitiveGroup& group) {
    GltfLook look = look_of(use, group);
    const MaterialDefinition& definition = look.definition;
    const ShaderUse* top = definition.surfaces.empty() ? nullptr : &definition.surfaces.back();
    Json result = Json::object();
    const char* extras = "its RSL shaders";
    bool is_all = false;  // what is not in extras
    if (look.is_gltf) {
        result = pbr_material(*top, look.bound, group, is_all);
        extras = "its shader's parameters (pbrMetallicRoughness comes near them)";
    } else if (top && std::any_of(std::begin(kModels), std::end(kModels),
                                  [&](auto* model) { return is_library_shader(*top, model); })) {
        result = common_material(definition, *top, look.bound, group);
        extras = "its shading model (pbrMetallicRoughness comes near it)";
    } else {
        result["pbrMetallicRoughness"] = {{"metallicFactor", 0},
                                          {"baseColorFactor", {0.8, 0.8, 0.8, 1}}};
    }
    if (!definition.id.empty()) result["name"] = definition.id;
    bool double_sided = !definition.hide_backfaces && description_.meshes[use.mesh].double_sided;
    if (double_sided) result["doubleSided"] = true;
    Json shaders = rsl_of(look, group);
    bool has_extras = !shaders.empty() && !(is_all && shaders.size() == 1);
    if (has_extras) result["extras"]["kinora_rsl"] = shaders;
    auto [found, fresh] = materials_.try_emplace(text_of(result), uint32_t(materials_.size()));
    if (fresh) {
        json_["materials"].push_back(result);
        if (!look.is_plain) tell_losses(definition, has_extras ? extras : "");
    }
    return found->second;
}

void GltfExport::tell_losses(const MaterialDefinition& definition, const char* extras) {
    if (!told_materials_.insert(&definition).second) return;
    std::string name = fmt::format("material '{}'", definition.id);
    Location where;
    bool moves = false;
    auto look = [&](const std::vector<ShaderUse>& uses) {
        for (const ShaderUse& use : uses)
            for (const ParamSource& p : use.params) {
                if (where.file == kNoFile) where = p.where;
                moves |= is_animated(p.value);
            }
    };
    look(definition.surfaces);
    look(definition.displacements);
    look(definition.transformations);
    if (moves) lost(name, "its animated parameters", where);
    if (*extras) in_extras(name, extras, where);
}

Location GltfExport::material_place(const ShaderUse& use) const {
    for (const ParamSource& p : use.params)
        if (p.where.file != kNoFile) return p.where;
    return {};
}

}  // namespace kinora
