// runtime/scene/dae/export_material.cpp: images, effects, lights and cameras.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "collada/document/edit.h"
#include "runtime/scene/dae/export_p.h"
#include "runtime/scene/dae/nearest_common.h"
#include "runtime/scene/description/display_color.h"
#include "runtime/scene/description/shader_library.h"

namespace kinora {

namespace fs = std::filesystem;

namespace {

bool is_library(const ShaderUse& use, std::string_view name) {
    return use.shader && use.shader->name == name && library_shader(name).get() == use.shader.get();
}

const ParamSource* source_of(const ShaderUse& use, std::string_view name) {
    for (const ParamSource& p : use.params)
        if (p.name == name) return &p;
    return nullptr;
}

// profile_COMMON's slots in the order of the schema, and what collada_*.sl calls them.
enum class SlotKind : uint8_t { Number, Light, Measure };  // Light: a display colour
struct SlotRow {
    const char *element, *param;
    SlotKind kind;
};
constexpr SlotRow kSlots[] = {{"emission", "emission", SlotKind::Light},
                              {"ambient", "ambient_color", SlotKind::Light},
                              {"diffuse", "diffuse", SlotKind::Light},
                              {"specular", "specular", SlotKind::Light},
                              {"shininess", "shininess", SlotKind::Number},
                              {"reflective", "reflective", SlotKind::Light},
                              {"reflectivity", "reflectivity", SlotKind::Number},
                              {"transparent", "transparent", SlotKind::Measure},
                              {"transparency", "transparency", SlotKind::Number},
                              {"index_of_refraction", "index_of_refraction", SlotKind::Number}};
struct ModelRow {
    const char *shader, *element;
    const char* slots;  // those it has, by number
};
constexpr ModelRow kModels[] = {{"collada_constant", "constant", "056789"},
                                {"collada_lambert", "lambert", "01256789"},
                                {"collada_phong", "phong", "0123456789"},
                                {"collada_blinn", "blinn", "0123456789"}};

constexpr const char* kWraps[] = {"WRAP", "MIRROR", "CLAMP", "BORDER"};

// `factor` times the colour, white where there is none, as COLLADA's <color> says it.
std::vector<double> display_color(std::span<const double> v, double factor) {
    bool grey = v.size() < 3;
    dvec3 linear = v.empty() ? dvec3(1.0) : dvec3(v[0], v[grey ? 0 : 1], v[grey ? 0 : 2]);
    dvec3 display = short_display_color(factor * linear, 1e-12);
    return {display.x, display.y, display.z};
}

}  // namespace

// The id of the <image> of a texture's file; files inside the scene's file go beside the document.
std::string ColladaExporter::image(const std::string& texture_name) {
    std::string path = parse_texture_name(texture_name).path;
    auto [found, fresh] = image_ids_.try_emplace(path);
    if (!fresh) return found->second;
    std::string own = found->second = id(fs::path(path).stem().string(), "image");
    std::error_code code;
    std::string link;
    std::string file = is_memory_file(path) ? path : description_.pictures.find(path).path;
    if (fs::is_regular_file(file, code)) {
        // ".." is seen from where links of the file system lead.
        auto folder_of = [&](const fs::path& of) {
            return fs::weakly_canonical(fs::absolute(of, code).parent_path(), code);
        };
        link = (folder_of(file) / fs::path(file).filename())
                   .lexically_relative(folder_of(path_))
                   .generic_string();
    } else if (std::string bytes = inner_file(path); !bytes.empty()) {
        const char* type = bytes.starts_with("\x89PNG") ? ".png" : ".jpg";
        link = fmt::format("{}_{}{}", fs::path(path_).stem().string(), own, type);
        result_.files.emplace_back(link, std::move(bytes));
    } else {
        lost(fmt::format("image '{}'", path), "it cannot be read");
        link = path;
    }
    bool utf8 = collada::utf8_text(link) == link;
    std::string escaped;
    for (char c : link) {
        uint8_t byte = uint8_t(c);
        bool plain = byte > ' ' && byte != 0x7f && !std::strchr("%#", c) && (utf8 || byte < 0x80);
        escaped += plain ? std::string(1, c) : fmt::format("%{:02X}", byte);
    }
    images_ +=
        xml("image", attribute("id", own), xml("init_from", "", collada::escape_text(escaped)));
    return own;
}

// The numbers that channels write, where they are decoded after.
ValueSlot ColladaExporter::written(ValueSlot color) const {
    for (const MovingColor& moving : description_.moving_colors)
        if (moving.linear == color.offset) return {moving.display, color.count};
    return color;
}

std::string ColladaExporter::inner_file(const std::string& name) const {
    for (const auto& file : description_.memory_files)
        if (file->name() == name) return {file->bytes().begin(), file->bytes().end()};
    return {};
}

namespace {

// By TextureMip, and whether the texels are read unfiltered.
constexpr const char* kMinFilters[][2] = {{"LINEAR_MIPMAP_LINEAR", "NEAREST_MIPMAP_LINEAR"},
                                          {"LINEAR_MIPMAP_NEAREST", "NEAREST_MIPMAP_NEAREST"},
                                          {"LINEAR", "NEAREST"}};

const char* min_filter(const TextureName& look) {
    return kMinFilters[size_t(look.mip)][look.nearest || look.nearest_minified];
}

// What a <sampler2D> says behind its <source>, in the order of the schema.
std::string sampler_state(const TextureName& look) {
    std::string state =
        xml("wrap_s", "", kWraps[size_t(look.wrap_s)]) +
        xml("wrap_t", "", kWraps[size_t(look.wrap_t)]) + xml("minfilter", "", min_filter(look)) +
        xml("magfilter", "", look.nearest || look.nearest_magnified ? "NEAREST" : "LINEAR");
    if (look.border != TextureName().border)
        state += xml("border_color", "", number_text(look.border));
    if (look.mip_max_level) state += xml("mipmap_maxlevel", "", std::to_string(look.mip_max_level));
    if (look.mip_bias != 0) state += xml("mipmap_bias", "", number_text(std::array{look.mip_bias}));
    return state;
}

}  // namespace

// <texture>, and in `params` its sampler. `extra` goes into its extra.
std::string ColladaExporter::texture(const ParamSource& map, const std::string& sid,
                                     const std::string& extra, std::string& params) {
    TextureName look = parse_texture_name(map.strings[0]);
    params += fmt::format(
        "<newparam sid=\"{0}-surface\"><surface type=\"2D\"><init_from>{1}</init_from>"
        "</surface></newparam><newparam sid=\"{0}-sampler\"><sampler2D><source>{0}-surface"
        "</source>{2}</sampler2D></newparam>",
        sid, image(map.strings[0]), sampler_state(look));
    std::string placed, more = extra;
    if (look.uv != TextureName().uv)
        placed += fmt::format(
            "<repeatU>{}</repeatU><repeatV>{}</repeatV><offsetU>{}</offsetU><offsetV>{}</offsetV>",
            look.uv[0], look.uv[1], look.uv[2], look.uv[3]);
    if (look.turn != TextureName().turn)
        placed += fmt::format("<rotateUV>{}</rotateUV>",
                              float(std::atan2(look.turn[1], look.turn[0]) * 180 / kPi));
    if (!placed.empty()) more += xml("technique", attribute("profile", "MAYA"), placed);
    std::string name = map.texcoord.empty() ? "TEXCOORD0" : map.texcoord;
    return xml("texture", attribute("texture", sid + "-sampler") + attribute("texcoord", name),
               more.empty() ? "" : xml("extra", "", more));
}

// The map of normals or heights of a COLLADA model, as the extra that exporters write.
std::string ColladaExporter::bump(const SeenSurface& seen, const std::string& effect,
                                  std::string& params) {
    const ShaderUse& use = seen.use;
    const ParamSource* map = source_of(use, "bump_map");
    if (!map || map->strings.empty() || map->strings[0].empty()) return "";
    const ParamSource* kind = source_of(use, "bump_kind");
    const ParamSource* amount = source_of(use, "bump_amount");
    bool normals = kind && !kind->strings.empty() && kind->strings[0] == "NORMALMAP";
    std::string extra;
    if (amount && amount->value.present())
        extra =
            xml("technique", attribute("profile", "MAX3D"),
                xml("amount", "", number_text(seen.numbers(amount->value, description_.values))));
    return xml("extra", "",
               xml("technique", attribute("profile", "FCOLLADA"),
                   xml("bump", attribute("bumptype", normals ? "NORMALMAP" : "HEIGHTFIELD"),
                       texture(*map, effect + "-bump", extra, params))));
}

// The same surface by the two modes of <transparent> that COLLADA 1.4.1 has: A_ONE and RGB_ZERO.
void ColladaExporter::in_modes_of_1_4(SeenSurface& seen, std::span<const double> values,
                                      const std::string& effect) {
    ShaderUse& use = seen.use;
    const ParamSource* mode = source_of(use, "opaque");
    std::string opaque = mode && !mode->strings.empty() ? mode->strings[0] : "NONE";
    if (opaque == "A_ONE" || opaque == "RGB_ZERO") return;
    auto number = [&](const char* name) {
        const ParamSource* p = source_of(use, name);
        return p && p->value.present() ? seen.numbers(p->value, values) : std::span<const double>();
    };
    std::span<const double> color = number("transparent"), alpha = number("transparent_alpha");
    double scale = number("transparency").empty() ? 1 : number("transparency")[0];
    dvec4 opacity(1.0);
    for (size_t k = 0; k < 3 && !color.empty(); ++k)
        opacity[int(k)] = color[std::min(k, color.size() - 1)];
    if (!alpha.empty()) opacity.w = alpha[0];
    if (source_of(use, "transparent_map") && opaque != "NONE") {
        if (!effect.empty())
            lost(fmt::format("effect '{}'", effect),
                 fmt::format("opaque=\"{}\" of a texture (1.4.1)", opaque));
        opaque = "NONE";
    }
    std::erase_if(use.params, [](const ParamSource& p) {
        return p.name.starts_with("transparen") || p.name == "opaque";
    });
    if (opaque == "NONE") return;
    opacity = dvec4(1.0) - scale * opacity;
    bool by_alpha = opaque == "A_ZERO";
    auto add = [&](const char* name, std::initializer_list<double> numbers) {
        ParamSource& p = use.params.emplace_back();
        p.name = name;
        p.value = {uint32_t(values.size() + seen.more.size()), uint32_t(numbers.size())};
        seen.more.insert(seen.more.end(), numbers);
    };
    if (by_alpha)
        add("transparent", {1, 1, 1});
    else
        add("transparent", {opacity.x, opacity.y, opacity.z});
    add("transparent_alpha", {by_alpha ? opacity.w : 1});
    add("transparency", {1});
    ParamSource& p = use.params.emplace_back();
    p.name = "opaque";
    p.strings = {by_alpha ? "A_ONE" : "RGB_ZERO"};
}

std::span<const double> SeenSurface::numbers(ValueSlot slot, std::span<const double> values) const {
    if (!slot.present()) return {};
    return slot.offset < values.size()
               ? values.subspan(slot.offset, slot.count)
               : std::span(more).subspan(slot.offset - values.size(), slot.count);
}

// What is lost is reported for an effect with a name.
SeenSurface ColladaExporter::seen_surface(const MaterialDefinition& m,
                                          std::span<const double> values,
                                          const std::string& effect) {
    SeenSurface seen{m.surfaces.back(), {}};
    if (has_nearest_common(seen.use)) {
        CommonSurface nearest = nearest_common(m.surfaces.back(), values, seen.more);
        for (const std::string& what : nearest.lost)
            if (!effect.empty() && !is_rsl(m)) lost(fmt::format("material '{}'", m.id), what);
        seen.use = std::move(nearest.use);
    }
    in_modes_of_1_4(seen, values, effect);
    return seen;
}

namespace {

// The numbers of a slot of profile_COMMON; none where it has none.
std::vector<double> slot_numbers(const SeenSurface& seen, const char* param, bool is_color,
                                 bool is_light, std::span<const double> values) {
    const ParamSource* p = source_of(seen.use, param);
    if (!p || !p->value.present()) return {};
    std::span<const double> own = seen.numbers(p->value, values);
    std::vector<double> v = is_light ? display_color(own, 1) : std::vector(own.begin(), own.end());
    if (!is_color) return v;
    v.resize(3, v.empty() ? 0.0 : v[0]);
    const ParamSource* alpha = source_of(seen.use, "transparent_alpha");
    bool with_alpha = alpha && std::string_view(param) == "transparent";
    v.push_back(with_alpha ? seen.numbers(alpha->value, values)[0] : 1.0);
    return v;
}

}  // namespace

// profile_COMMON: COLLADA's own model as it is; of others the colors that any viewer understands.
std::string ColladaExporter::common(const MaterialDefinition& definition, const SeenSurface* seen,
                                    const std::string& effect) {
    const ShaderUse* use = seen ? &seen->use : nullptr;
    const ModelRow* model = nullptr;
    for (const ModelRow& row : kModels)
        if (use && is_library(*use, row.shader)) model = &row;
    std::string params, slots;
    std::vector<ValueSlot> sources;  // numbers that the surface is made of
    if (model)
        for (const ParamSource& p : definition.surfaces.back().params)
            if (p.value.present()) sources.push_back(p.value);
    auto moves = [&](const SlotRow& row, const char* param, bool is_color) {
        if (!model) return false;
        const std::string target = effect + "/common/" + row.element;
        const ValueSlot own = source_of(*use, param)->value, channel = written(own);
        bool is_light = row.kind == SlotKind::Light;
        bool as_it_is = own.offset < description_.values.size() &&
                        (!is_light || channel.offset != own.offset) &&
                        row.kind != SlotKind::Measure;
        if (as_it_is) {
            animation_.name(channel, target, nullptr);
            return animation_.moves(channel);
        }
        return animation_.name_made(target, sources, [&](const std::vector<double>& values) {
            return slot_numbers(seen_surface(definition, values, ""), param, is_color, is_light,
                                values);
        });
    };
    auto value = [&](const SlotRow& row, const char* param) -> std::string {
        const ParamSource* map = use ? source_of(*use, std::string(param) + "_map") : nullptr;
        bool is_color = row.kind != SlotKind::Number;
        if (map && !map->strings.empty() && !map->strings[0].empty() && is_color)
            return texture(*map, fmt::format("{}-{}", effect, row.element), "", params);
        if (!use) return "";
        std::vector<double> v =
            slot_numbers(*seen, param, is_color, row.kind == SlotKind::Light, description_.values);
        if (v.empty()) return "";
        return xml(is_color ? "color" : "float",
                   moves(row, param, is_color) ? attribute("sid", row.element) : "",
                   number_text(v));
    };
    auto add = [&](const SlotRow& row, const char* param) {
        std::string content = value(row, param);
        std::string opaque;
        const ParamSource* mode = use ? source_of(*use, "opaque") : nullptr;
        if (mode && !mode->strings.empty() && std::string_view(row.element) == "transparent" &&
            mode->strings[0] != "NONE")
            opaque = attribute("opaque", mode->strings[0]);
        if (!content.empty()) slots += xml(row.element, opaque, content);
    };
    if (model) {
        for (const char* s = model->slots; *s; ++s) add(kSlots[*s - '0'], kSlots[*s - '0'].param);
    } else {
        add(kSlots[0], "emissive");
        add(kSlots[2], use && source_of(*use, "base_color") ? "base_color" : "surfacecolor");
    }
    std::string shading = xml(model ? model->element : "lambert", "", slots);
    std::string extra = model ? bump(*seen, effect, params) : "";
    if (definition.hide_backfaces)
        extra +=
            "<extra><technique profile=\"GOOGLEEARTH\"><double_sided>0</double_sided>"
            "</technique></extra>";
    return xml("profile_COMMON", "",
               params + xml("technique", attribute("sid", "common"), shading + extra));
}

// Whether it is more than one of COLLADA's or glTF's own surfaces: only RSL says that.
bool ColladaExporter::is_rsl(const MaterialDefinition& m) const {
    size_t others = m.transformations.size() + m.displacements.size() + m.interior.size() +
                    m.exterior.size() + m.lights.size();
    if (others + m.surfaces.size() != 1 || m.surfaces.empty())
        return others + m.surfaces.size() > 0;
    if (has_nearest_common(m.surfaces[0])) return false;
    return std::none_of(std::begin(kModels), std::end(kModels),
                        [&](const ModelRow& row) { return is_library(m.surfaces[0], row.shader); });
}

std::string ColladaExporter::effect(uint32_t index) {
    const MaterialDefinition& m = description_.materials[index];
    std::string own = id(material_ids_[index] + "-effect", "effect");
    std::vector<const ShaderUse*> uses;
    for (const auto* list :
         {&m.transformations, &m.displacements, &m.surfaces, &m.interior, &m.exterior, &m.lights})
        for (const ShaderUse& use : *list) uses.push_back(&use);
    std::optional<SeenSurface> seen;
    if (!m.surfaces.empty()) seen = seen_surface(m, description_.values, own);
    std::string profiles = common(m, seen ? &*seen : nullptr, own);
    if (is_rsl(m)) profiles += rsl(uses, own);
    effects_ += xml("effect", attribute("id", own), profiles);
    return own;
}

// <extra><technique profile="RSL"> with an <instance_effect> of these shaders.
std::string ColladaExporter::rsl_extra(const std::vector<ShaderUse>& uses,
                                       const std::string& owner) {
    std::string instances;
    for (const ShaderUse& use : uses) {
        std::string own = id(owner + "-rsl", "effect");
        effects_ +=
            xml("effect", attribute("id", own), common({}, nullptr, own) + rsl({&use}, own));
        instances += xml("instance_effect", attribute("url", "#" + own), "");
    }
    return instances.empty()
               ? ""
               : xml("extra", "", xml("technique", attribute("profile", "RSL"), instances));
}

namespace {

// Of the cosine to that power which is 1/2 where the edge of glTF's cone is
// (KHR_lights_punctual: the square of a ramp over the cosine).
double falloff_exponent(double inner, double outer) {
    double cosine = std::cos(outer) + std::sqrt(0.5) * (std::cos(inner) - std::cos(outer));
    return cosine < 1 && cosine > 0 ? std::log(0.5) / std::log(cosine) : 0;
}

// The first number of a light's parameters by the values of a time.
struct LightNumbers {
    const ShaderUse& shader;
    std::span<const double> values;

    double operator()(const char* name, double otherwise) const {
        const ParamSource* p = source_of(shader, name);
        return p && p->value.present() ? values[p->value.offset] : otherwise;
    }
};

// 0 where glTF's cone has a hard edge.
double soft_exponent(const LightNumbers& n) {
    double outer = n("outer_angle", kPi / 4), inner = n("inner_angle", 0);
    return inner < 0.99 * outer ? falloff_exponent(inner, outer) : 0;
}

struct LightRow {
    const char *shader, *element;
    bool falls_off, cone;
};
constexpr LightRow kLightRows[] = {{"collada_ambient", "ambient", false, false},
                                   {"collada_directional", "directional", false, false},
                                   {"collada_point", "point", true, false},
                                   {"collada_spot", "spot", true, true},
                                   {"gltf_directional", "directional", false, false},
                                   {"gltf_point", "point", true, false},
                                   {"gltf_spot", "spot", true, true}};

// Null for lights in RSL.
const LightRow* light_row(const ShaderUse& shader) {
    for (const LightRow& row : kLightRows)
        if (is_library(shader, row.shader)) return &row;
    return nullptr;
}

}  // namespace

std::string ColladaExporter::light(uint32_t index) {
    const LightDefinition& l = description_.lights[index];
    const LightRow* row = light_row(l.shader);
    const std::string& own = light_ids_[index];
    bool theirs = row && std::string_view(row->shader).starts_with("gltf");
    LightNumbers now{l.shader, description_.values};
    const ParamSource* tint = source_of(l.shader, "lightcolor");
    ValueSlot color = tint ? tint->value : ValueSlot{};
    std::vector<ValueSlot> sources;
    for (const ParamSource& p : l.shader.params)
        if (p.value.present()) sources.push_back(p.value);
    std::string content;
    auto put = [&](const char* name, bool moves, std::span<const double> numbers) {
        content += xml(name, moves ? attribute("sid", name) : "", number_text(numbers));
    };
    auto made = [&](const char* name, const NumbersAt& numbers) {
        bool moves = row && animation_.name_made(own + "/" + name, sources, numbers);
        put(name, moves, numbers(description_.values));
    };
    auto as_it_is = [&](const char* name, ValueSlot slot, std::span<const double> numbers) {
        animation_.name(slot, own + "/" + name, nullptr);
        put(name, animation_.moves(slot), numbers);
    };
    // gltf_*.sl: Cl = color * intensity / PI, point and spot lights over d^2.
    auto color_at = [&](const std::vector<double>& values) {
        double factor = theirs ? LightNumbers{l.shader, values}("intensity", 1) / kPi : 1.0;
        return display_color(color.present() ? std::span(values).subspan(color.offset, color.count)
                                             : std::span<const double>(),
                             factor);
    };
    if (written(color).offset != color.offset)
        as_it_is("color", written(color), color_at(description_.values));
    else
        made("color", color_at);
    auto add = [&](const char* name, double otherwise) {
        const ParamSource* p = source_of(l.shader, name);
        double value = now(name, otherwise);
        as_it_is(name, p ? p->value : ValueSlot{}, std::span<const double>(&value, 1));
    };
    // Of gltf_*.sl, from the numbers of a time.
    auto add_made = [&](const char* name, auto&& value) {
        made(name, [&](const std::vector<double>& values) {
            return std::vector<double>{value(LightNumbers{l.shader, values})};
        });
    };
    if (row && row->falls_off && theirs) {
        add("constant_attenuation", 0);
        add("linear_attenuation", 0);
        double unit = now("unit", 1);  // of the scene's in a metre
        add("quadratic_attenuation", 1 / (unit * unit));
    } else if (row && row->falls_off) {
        add("constant_attenuation", 1);
        add("linear_attenuation", 0);
        add("quadratic_attenuation", 0);
    }
    std::string name = fmt::format("light '{}'", own);
    if (row && row->cone && theirs) {
        add_made("falloff_angle",
                 [](const LightNumbers& n) { return n("outer_angle", kPi / 4) * 360 / kPi; });
        add_made("falloff_exponent", soft_exponent);
        if (soft_exponent(now) != 0)
            lost(name, "the edge of its cone (a power of the cosine comes near)");
    } else if (row && row->cone) {
        add("falloff_angle", 180);
        add("falloff_exponent", 0);
    }
    if (theirs && row->falls_off && now("range", 0) > 0) lost(name, "where its range ends");
    std::string extra = row ? "" : rsl_extra({l.shader}, own);
    if (l.blender)
        extra += xml("extra", "",
                     xml("technique", attribute("profile", "KINORA"), xml("grey_world", "", "1")));
    return xml("light",
               attribute("id", own) + (l.name.empty() ? "" : attribute("name", xml_name(l.name))),
               xml("technique_common", "", xml(row ? row->element : "point", "", content)) + extra);
}

std::string ColladaExporter::camera(uint32_t index) {
    const CameraDefinition& c = description_.cameras[index];
    const std::string& own = camera_ids_[index];
    std::string content;
    auto add = [&](const char* name, ValueSlot slot, double otherwise = 0) {
        double value = slot.present() ? values(slot)[0] : otherwise;
        if (!slot.present() && otherwise == 0) return;
        animation_.name(slot, own + "/" + name, nullptr);
        content += xml(name, animation_.moves(slot) ? attribute("sid", name) : "",
                       number_text(std::span<const double>(&value, 1)));
    };
    add(c.orthographic ? "xmag" : "xfov", c.x);
    add(c.orthographic ? "ymag" : "yfov", c.y);
    if (!(c.x.present() && c.y.present())) add("aspect_ratio", c.aspect);
    add("znear", c.znear, 0.01);
    add("zfar", c.zfar, 1e6);  // the schema wants both
    std::vector<ShaderUse> picture = c.picture.atmosphere;
    picture.insert(picture.end(), c.picture.imagers.begin(), c.picture.imagers.end());
    std::string kind = c.orthographic ? "orthographic" : "perspective";
    return xml("camera",
               attribute("id", own) + (c.name.empty() ? "" : attribute("name", xml_name(c.name))),
               xml("optics", "", xml("technique_common", "", xml(kind, "", content))) +
                   rsl_extra(picture, own));
}

}  // namespace kinora
