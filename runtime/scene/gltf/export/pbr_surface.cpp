// runtime/scene/gltf/export/pbr_surface.cpp: glTF's own materials, written back.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/scene/gltf/export/surfaces.h"

namespace kinora {

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

// A number that glTF has within [0, 1]; `is_all` false where it is cut.
double unit(double x, bool& is_all) {
    is_all &= x >= 0 && x <= 1;
    return clamp01(x);
}

void set(Json& object, const char* name, Json info) {
    if (!info.is_null()) object[name] = std::move(info);
}

}  // namespace

Json SurfaceWriter::texture_info(const ParamSource& map, const MaterialUse& use,
                                 const PrimitiveGroup& group) {
    const std::string& name = map.strings[0];
    uint32_t index = textures_.write(name);
    if (index == kNone) return nullptr;
    Json info = {{"index", index}};
    if (uint32_t set = texcoord_index(map.texcoord, use, group)) info["texCoord"] = set;
    std::array<float, 4> uv = parse_texture_name(name).uv;
    if (uv != std::array<float, 4>{1, 1, 0, 0}) {
        // s' = s a + c, t' = t b + d with t = 1 - v.
        Json transform = {{"offset", {uv[2], 1 - uv[1] - uv[3]}}, {"scale", {uv[0], uv[1]}}};
        info["extensions"]["KHR_texture_transform"] = transform;
        document_.use_extension("KHR_texture_transform");
    }
    return info;
}

Json SurfaceWriter::map_info(const ShaderUse& shader, const std::string& slot,
                             const MaterialUse& use, const PrimitiveGroup& group) {
    const ParamSource* map = find_map(shader, slot);
    return map ? texture_info(*map, use, group) : Json();
}

Json SurfaceWriter::pbr_map_info(const UsedParams& params, const std::string& slot, bool data,
                                 const MaterialUse& use, const PrimitiveGroup& group,
                                 bool& is_all) {
    const ParamSource* map = find_map(params.use, slot);
    if (!map) return nullptr;
    Json info = texture_info(*map, use, group);
    TextureName name = parse_texture_name(map->strings[0]);
    Json transform = texture_transform(params, slot, is_all);
    bool transformed_twice = !transform.is_null() && name.uv != TextureName().uv;
    is_all &= fits_gltf_sampler(name) && name.data == data && !transformed_twice;
    if (info.is_null() || transform.is_null() || transformed_twice) return info;
    info["extensions"]["KHR_texture_transform"] = transform;
    document_.use_extension("KHR_texture_transform");
    return info;
}

void SurfaceWriter::extend(Json& material, const char* extension, Json value) {
    material["extensions"][extension] = std::move(value);
    document_.use_extension(extension);
}

Json SurfaceWriter::pbr(const UsedParams& p, const MaterialUse& use, const PrimitiveGroup& group,
                        bool& is_all) {
    is_all &= use.params.empty();
    dvec3 base = p.color("base_color", 1);
    Json pbr = {{"baseColorFactor",
                 {unit(base.x, is_all), unit(base.y, is_all), unit(base.z, is_all),
                  unit(p.number("base_alpha", 1), is_all)}}};
    Json material = Json::object();
    auto map = [&](const std::string& slot, bool data) {
        return pbr_map_info(p, slot, data, use, group, is_all);
    };
    set(pbr, "baseColorTexture", map("base_color", false));
    if (p.use.shader->name == "gltf_unlit") {
        extend(material, "KHR_materials_unlit", Json::object());
    } else {
        pbr["metallicFactor"] = unit(p.number("metallic", 1), is_all);
        pbr["roughnessFactor"] = unit(p.number("roughness", 1), is_all);
        set(pbr, "metallicRoughnessTexture", map("metallic_roughness", true));
        if (Json info = map("normal", true); !info.is_null()) {
            info["scale"] = p.number("normal_scale", 1);
            material["normalTexture"] = info;
        }
        if (Json info = map("occlusion", true); !info.is_null()) {
            info["strength"] = unit(p.number("occlusion_strength", 1), is_all);
            material["occlusionTexture"] = info;
        }
        set(material, "emissiveTexture", map("emissive", false));
        write_emission(p, material);
        if (Json info = map("specular_glossiness", false); !info.is_null())
            write_specular_glossiness(p, pbr, info, material, is_all);
        else
            write_reflection(p, material, is_all);
    }
    material["pbrMetallicRoughness"] = pbr;
    std::string mode = p.text("alpha_mode");
    if (mode == "BLEND" || mode == "MASK") material["alphaMode"] = mode;
    if (mode == "MASK") material["alphaCutoff"] = std::max(p.number("alpha_cutoff", 0.5), 0.0);
    return material;
}

void SurfaceWriter::write_emission(const UsedParams& p, Json& material) {
    dvec3 emissive = p.color("emissive", 0);
    double most = std::max({emissive.x, emissive.y, emissive.z, 1.0});
    if (emissive != dvec3(0.0))
        material["emissiveFactor"] = {emissive.x / most, emissive.y / most, emissive.z / most};
    if (most > 1) extend(material, "KHR_materials_emissive_strength", {{"emissiveStrength", most}});
}

// The one word for a map of both; readers without it have the base color on plastic. It excludes
// KHR_materials_ior and KHR_materials_specular.
void SurfaceWriter::write_specular_glossiness(const UsedParams& p, Json& pbr, Json texture,
                                              Json& material, bool& is_all) {
    dvec3 specular = p.color("specular_color", 1);
    Json glossy = {{"diffuseFactor", pbr["baseColorFactor"]},
                   {"specularFactor",
                    {unit(specular.x, is_all), unit(specular.y, is_all), unit(specular.z, is_all)}},
                   {"glossinessFactor", unit(1 - p.number("roughness", 1), is_all)},
                   {"specularGlossinessTexture", std::move(texture)}};
    if (pbr.contains("baseColorTexture")) glossy["diffuseTexture"] = pbr["baseColorTexture"];
    pbr["roughnessFactor"] = 0.5;
    extend(material, "KHR_materials_pbrSpecularGlossiness", std::move(glossy));
}

// What a dielectric reflects.
void SurfaceWriter::write_reflection(const UsedParams& p, Json& material, bool& is_all) {
    // KHR_materials_ior: an ior of 0 reflects all.
    double r = std::sqrt(unit(p.number("dielectric_F0", 0.04), is_all));
    if (std::abs(r - 0.2) > 1e-9)
        extend(material, "KHR_materials_ior", {{"ior", r < 1 ? (1 + r) / (1 - r) : 0.0}});
    dvec3 tint = p.color("specular_color", 1);
    double specular = p.number("specular", 1);
    if (specular != 1 || tint != dvec3(1.0))
        extend(material, "KHR_materials_specular",
               {{"specularFactor", unit(specular, is_all)},
                {"specularColorFactor",
                 {std::max(tint.x, 0.0), std::max(tint.y, 0.0), std::max(tint.z, 0.0)}}});
}

}  // namespace kinora
