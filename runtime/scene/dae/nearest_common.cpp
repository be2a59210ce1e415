// runtime/scene/dae/nearest_common.cpp: base colour, metal and roughness as diffuse, specular,
// shininess.
#include "runtime/scene/dae/nearest_common.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/description/texture_name.h"

namespace kinora {

namespace {

// Past this a highlight is a point.
constexpr double kMostShininess = 1000;

// What a metal reflects of light from everywhere, as gltf_pbr.sl has it (reflected_everywhere)
// where the surface is seen under 45 degrees; the color is a factor.
double metal_albedo(double rough) {
    constexpr double kNV = 0.7;
    double rx = 1 - rough, ry = 0.0425 - 0.0275 * rough, rz = 1.04 - 0.572 * rough;
    double a = std::min(rx * rx, std::exp2(-9.28 * kNV)) * rx + ry;
    return rz - 1.04 * a;
}

// Which part of that a diffuse color shows: a rough metal spreads all light, a smooth one mirrors
// lamps as points, and its surroundings, which stand in the diffuse color, are darker than lamps.
double metal_diffusion(double rough) {
    return 0.3 + 0.6 * rough * rough;
}

class GltfToCommon {
  public:
    GltfToCommon(const ShaderUse& from, std::span<const double> values,
                 std::vector<double>& numbers)
        : from_(from), values_(values), numbers_(numbers) {}

    CommonSurface run() {
        bool unlit = from_.shader->name == "gltf_unlit";
        bool none = from_.shader->name == "default_surface";
        to_.use.shader = library_shader(unlit  ? "collada_constant"
                                        : none ? "collada_lambert"
                                               : "collada_blinn");
        to_.use.linear_inputs = true;
        if (unlit)
            light("emission", "base_color", color("base_color", 1));
        else if (none)
            for (const char* slot : {"ambient_color", "diffuse"})
                set(slot, color("diffuse_color", 0.8));
        else
            shade();
        opacity();
        if (tinted_) to_.lost.push_back("a colour that tints a texture");
        return std::move(to_);
    }

  private:
    const ParamSource* source(std::string_view name) const {
        for (const ParamSource& p : from_.params)
            if (p.name == name) return &p;
        return nullptr;
    }
    dvec3 color(std::string_view name, double otherwise) const {
        const ParamSource* p = source(name);
        if (!p || !p->value.present()) return dvec3(otherwise);
        const double* v = &values_[p->value.offset];
        return p->value.count < 3 ? dvec3(v[0]) : dvec3(v[0], v[1], v[2]);
    }
    double number(std::string_view name, double otherwise) const {
        return color(name, otherwise).x;
    }
    std::string text(std::string_view name) const {
        const ParamSource* p = source(name);
        return p && !p->strings.empty() ? p->strings[0] : "";
    }

    void set(const char* name, std::initializer_list<double> values) {
        ParamSource& p = to_.use.params.emplace_back();
        p.name = name;
        p.value = {uint32_t(values_.size() + numbers_.size()), uint32_t(values.size())};
        numbers_.insert(numbers_.end(), values);
    }
    void set(const char* name, const dvec3& c) { set(name, {c.x, c.y, c.z}); }
    void set_text(const char* name, std::string value) {
        ParamSource& p = to_.use.params.emplace_back();
        p.name = name;
        p.strings = {std::move(value)};
    }

    // The texture of a slot of glTF with its transform (KHR_texture_transform as gltf_pbr.sl has
    // it); false where there is none.
    bool set_map(const std::string& to, const std::string& from, bool data = false) {
        const ParamSource* map = source(from + "_map");
        if (!map || map->strings.empty() || map->strings[0].empty()) return false;
        TextureName name = parse_texture_name(map->strings[0]);
        name.data = data;
        auto row = [&](const char* entry, double otherwise) {
            return float(number(from + entry, otherwise));
        };
        if (row("_st", 0) != 0 || row("_ts", 0) != 0)
            to_.lost.push_back("how its textures are turned");
        else
            name.uv = {row("_ss", 1) * name.uv[0], row("_tt", 1) * name.uv[1],
                       row("_ss", 1) * name.uv[2] + row("_so", 0),
                       row("_tt", 1) * name.uv[3] + row("_to", 0)};
        ParamSource made = *map;
        made.name = to + "_map";
        made.strings = {texture_name_string(name)};
        to_.use.params.push_back(std::move(made));
        return true;
    }

    // A slot shows a colour or a texture, never both.
    void light(const char* to, const char* from, const dvec3& factor) {
        if (!set_map(to, from))
            set(to, factor);
        else
            tinted_ |= factor != dvec3(1.0);
    }

    void shade() {
        bool mapped = !text("metallic_roughness_map").empty();
        if (mapped) to_.lost.push_back("its map of metal and roughness");
        const bool glossy = !text("specular_glossiness_map").empty();
        if (glossy) to_.lost.push_back("its map of specular color and glossiness");
        if (!text("occlusion_map").empty()) to_.lost.push_back("its map of occlusion");
        // Where a map says what is metal, most is none.
        double metal = mapped ? 0 : std::clamp(number("metallic", 1), 0.0, 1.0);
        dvec3 base = color("base_color", 1);
        double rough = glossy ? 0.5 : std::clamp(number("roughness", 1), 0.0, 1.0);
        bool textured = !text("base_color_map").empty();
        dvec3 mirrored = textured ? dvec3(0.0) : base * (metal * metal_albedo(rough));
        dvec3 factor = textured ? base : base * (1 - metal);
        light("ambient_color", "base_color", factor + mirrored);
        light("diffuse", "base_color", factor + mirrored * metal_diffusion(rough));
        if (textured && metal > 0) to_.lost.push_back("metal under a texture");
        if (!textured && metal > 0)
            to_.lost.push_back("that it is metal (a diffuse color and a highlight come near it)");
        if (dvec3 glow = color("emissive", 0); glow != dvec3(0.0))
            light("emission", "emissive", glow);

        // F0 and alpha2 of gltf_pbr.sl. Most of what has a map of reflections is plastic.
        dvec3 dielectric = glossy ? dvec3(0.04)
                                  : number("specular", 1) * glm::min(number("dielectric_F0", 0.04) *
                                                                         color("specular_color", 1),
                                                                     dvec3(1.0));
        dvec3 F0 = glm::mix(dielectric, textured ? dielectric : base, metal);
        double alpha2 = std::max(std::pow(rough, 4), 2 / (kMostShininess + 2));
        set("specular", F0 / (4 * alpha2));
        set("shininess", {2 / alpha2 - 2});

        if (set_map("bump", "normal", true)) {
            set_text("bump_kind", "NORMALMAP");
            set("bump_amount", {number("normal_scale", 1)});
        }
    }

    void opacity() {
        std::string mode = text("alpha_mode");
        if (mode != "BLEND" && mode != "MASK") return;
        if (mode == "MASK") to_.lost.push_back("a sharp edge of its alpha");
        set_text("opaque", "A_ONE");
        if (!set_map("transparent", "base_color", true)) {
            set("transparent", dvec3(1.0));
            set("transparent_alpha", {1});
        }
        set("transparency", {number("base_alpha", 1)});
    }

    const ShaderUse& from_;
    std::span<const double> values_;
    std::vector<double>& numbers_;
    CommonSurface to_;
    bool tinted_ = false;
};

}  // namespace

bool has_nearest_common(const ShaderUse& surface) {
    if (!surface.shader) return false;
    for (const char* name : {"gltf_pbr", "gltf_unlit", "default_surface"})
        if (surface.shader->name == name && library_shader(name).get() == surface.shader.get())
            return true;
    return false;
}

CommonSurface nearest_common(const ShaderUse& surface, std::span<const double> values,
                             std::vector<double>& numbers) {
    return GltfToCommon(surface, values, numbers).run();
}

}  // namespace kinora
