// runtime/gltf/export/rsl.cpp: shaders as extras, textures and lights.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/geometric.hpp>
#include <iterator>

#include "collada/document/edit.h"
#include "runtime/description/findings.h"
#include "runtime/description/memory_file.h"
#include "runtime/description/texture_name.h"
#include "runtime/gltf/export/export_p.h"
#include "runtime/images/image_io.h"
#include "runtime/images/texture_image.h"

namespace kinora {

namespace fs = std::filesystem;

namespace {

std::string read_bytes(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

const char* mime_type(const std::string& bytes) {
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) return "image/png";
    if (bytes.starts_with("\xff\xd8\xff")) return "image/jpeg";
    return nullptr;
}

uint8_t encoded_byte(float x) {  // IEC 61966-2-1
    x = std::clamp(std::isfinite(x) ? x : 0.0f, 0.0f, 1.0f);
    float y = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
    return uint8_t(std::lround(255 * y));
}

// Other formats as PNG; what that cuts off is said in `loss`.
std::string as_png(const std::string& path, std::string& error, std::string& loss) {
    TextureImage image;
    error = read_texture_image(path, image);
    if (!error.empty()) return {};
    Image8 out{image.width, image.height, image.bytes};
    if (image.is_float()) {
        loss = "values beyond 8 bits";
        out.rgba.resize(image.floats.size());
        for (size_t i = 0; i < image.floats.size(); ++i)
            out.rgba[i] = i % 4 == 3 || image.encoded
                              ? uint8_t(std::lround(255 * std::clamp(image.floats[i], 0.0f, 1.0f)))
                              : encoded_byte(image.floats[i]);
    }
    fs::path temporary = fs::temp_directory_path() / fmt::format("kinora-{}.png", getpid());
    error = write_png(temporary.string(), out, {});
    std::string bytes = error.empty() ? read_bytes(temporary.string()) : "";
    std::error_code code;
    fs::remove(temporary, code);
    return bytes;
}

// glTF 2.0, sampler.
constexpr int kWraps[] = {10497, 33648, 33071, 33071};  // TextureWrap
// OpenGL's numbers, which glTF uses: NEAREST, LINEAR, then x_MIPMAP_NEAREST and x_MIPMAP_LINEAR.
constexpr int kNearest = 9728, kMipped = 9984;

int min_filter(const TextureName& look) {
    bool linear = !look.nearest && !look.nearest_minified;
    if (look.mip == TextureMip::None) return kNearest + linear;
    return kMipped + linear + 2 * (look.mip == TextureMip::Linear && !look.nearest);
}

}  // namespace

uint32_t GltfExport::image(const std::string& path) {
    auto [found, fresh] = images_.try_emplace(path, kNone);
    if (!fresh) return found->second;
    AllowedPaths::Found file =
        is_memory_file(path) ? AllowedPaths::Found{path} : description_.readable.find(path);
    std::string bytes, error, loss;
    if (file.outside) {
        lost(fmt::format("image '{}'", path), "it lies outside the scene's folder");
        return kNone;
    }
    bytes = read_bytes(FileToOpen(file.path).path());
    const char* type = mime_type(bytes);
    if (!type) {
        bytes = as_png(file.path, error, loss);
        type = "image/png";
    }
    if (bytes.empty()) {
        lost(fmt::format("image '{}'", path), error.empty() ? "it cannot be read" : error);
        return kNone;
    }
    if (!loss.empty()) lost(fmt::format("image '{}'", path), loss);
    json_["images"].push_back({{"name", fs::path(path).filename().string()},
                               {"bufferView", buffer_view(bytes.data(), bytes.size(), 0)},
                               {"mimeType", type}});
    return found->second = uint32_t(json_["images"].size() - 1);
}

uint32_t GltfExport::texture(const std::string& name) {
    TextureName look = parse_texture_name(name);
    uint32_t source = image(look.path);
    if (source == kNone) return kNone;
    Json sampler = {{"magFilter", kNearest + !(look.nearest || look.nearest_magnified)},
                    {"minFilter", min_filter(look)},
                    {"wrapS", kWraps[size_t(look.wrap_s)]},
                    {"wrapT", kWraps[size_t(look.wrap_t)]}};
    std::string key = fmt::format("{} {}", source, text_of(sampler));
    auto [found, fresh] = textures_.try_emplace(key, uint32_t(textures_.size()));
    if (!fresh) return found->second;
    if (look.wrap_s == TextureWrap::Border || look.wrap_t == TextureWrap::Border)
        lost(fmt::format("image '{}'", look.path), "its border color (edges are repeated)");
    json_["samplers"].push_back(sampler);
    json_["textures"].push_back({{"sampler", json_["samplers"].size() - 1}, {"source", source}});
    return found->second;
}

bool fits_gltf_sampler(const TextureName& look) {
    return look.wrap_s != TextureWrap::Border && look.wrap_t != TextureWrap::Border &&
           look.turn == TextureName().turn && look.mip_bias == 0 && look.mip_max_level == 0;
}

// {"library": name} or {"code", "shader"}, and "params"; import_gltf_rsl reads it.
Json GltfExport::rsl(const ShaderUse& use) {
    if (!use.shader) return nullptr;
    Json result;
    if (is_library_shader(use, use.shader->name)) {
        result["library"] = use.shader->name;
    } else {
        result["code"] = collada::utf8_text(rsl::print_ast(*use.shader->ast));
        result["shader"] = use.shader->name;
    }
    Json params = Json::object();
    for (const ParamSource& p : use.params) {
        if (!p.strings.empty()) {
            std::error_code code;
            std::string path = parse_texture_name(p.strings[0]).path;
            uint32_t index = kNone;
            if (p.strings.size() == 1 && (is_memory_file(path) || fs::is_regular_file(path, code)))
                index = texture(p.strings[0]);
            if (index != kNone) {
                TextureName look = parse_texture_name(p.strings[0]);
                params[p.name]["texture"] = index;
                if (look.data) params[p.name]["data"] = true;
                if (look.uv != TextureName().uv) params[p.name]["uv"] = look.uv;
                if (!fits_gltf_sampler(look))
                    params[p.name]["look"] = p.strings[0].substr(path.size() + 1);
            } else if (p.strings.size() == 1) {
                params[p.name] = p.strings[0];
            } else {
                params[p.name] = p.strings;
            }
        } else if (std::span<const double> v = values(p.value); v.size() == 1) {
            params[p.name] = v[0];
        } else if (!v.empty()) {
            params[p.name] = std::vector<double>(v.begin(), v.end());
        }
    }
    if (!params.empty()) result["params"] = params;
    return result;
}

Json GltfExport::rsl(const std::vector<ShaderUse>& uses) {
    if (uses.size() == 1) return rsl(uses[0]);
    Json list = Json::array();
    for (const ShaderUse& use : uses) list.push_back(rsl(use));
    return list;
}

Json GltfExport::rsl_of(const GltfLook& look, const PrimitiveGroup& group) {
    const MaterialDefinition& m = look.definition;
    const MaterialUse& bound = look.bound;
    Json result = Json::object();
    auto add = [&](const char* stage, const std::vector<ShaderUse>& uses) {
        if (uses.empty()) return;
        result[stage] = rsl(uses);
        if (uses.size() != 1) return;
        Json sets = Json::object();
        for (const ParamSource& p : uses[0].params)
            if (uint32_t set = p.texcoord.empty() ? 0 : texcoord_index(p.texcoord, bound, group))
                sets[p.name] = set;
        if (!sets.empty()) result[stage]["texcoords"] = sets;
        for (const auto& [name, slot] : bound.params) {  // <bind semantic target>
            std::span<const double> v = values(slot);
            if (v.size() == 1)
                result[stage]["params"][name] = v[0];
            else if (!v.empty())
                result[stage]["params"][name] = std::vector<double>(v.begin(), v.end());
        }
    };
    add("transformation", m.transformations);
    add("displacement", m.displacements);
    add("surface", m.surfaces);
    add("volume", m.interior);
    add("exterior", m.exterior);
    add("light", m.lights);
    if (result.contains("light") && m.light_samples) result["light_samples"] = m.light_samples;
    // Vertex inputs of RSL parameters; import_gltf binds TEXCOORD_n by itself.
    if (result.empty()) return result;
    std::vector<GltfAttribute> attributes = attributes_of(look, group);
    for (const VertexBinding& b : bound.vertex_bindings)
        for (const GltfAttribute& a : attributes) {
            bool same = a.attribute->semantic == b.semantic &&
                        (b.set == kNone || b.set == a.attribute->set);
            if (!same) continue;
            if (a.name != b.param) result["inputs"][b.param] = a.name;
            break;
        }
    return result;
}

namespace {

// What glTF's light says of one of ours.
struct PunctualLight {
    Json json;
    bool more = true;  // the shader does more: the extras bring it
    const char* beyond = "its RSL shader";
};

PunctualLight punctual(const char* type, double intensity, const dvec3& color, double most) {
    PunctualLight light;
    light.json["type"] = type;
    light.json["intensity"] = std::isfinite(intensity) ? std::max(intensity, 0.0) : 0.0;
    if (most > 0)
        light.json["color"] = {std::max(color.x, 0.0) / most, std::max(color.y, 0.0) / most,
                               std::max(color.z, 0.0) / most};
    return light;
}

// What the light is divided by at that distance (COLLADA 1.4.1). Attenuations are per unit of the
// file, of `meter` metres.
double attenuation(const UsedParams& p, double meters, double meter) {
    double d = meters / meter;
    return p.number("constant_attenuation", 1) + d * p.number("linear_attenuation", 0) +
           d * d * p.number("quadratic_attenuation", 0);
}

Json collada_cone(const UsedParams& p) {
    double half = std::clamp(radians(0.5 * p.number("falloff_angle", 180)), 1e-3, kPi / 2);
    bool hard = p.number("falloff_exponent", 0) <= 0;
    return {{"innerConeAngle", hard ? half * (1 - 1e-6) : 0.0}, {"outerConeAngle", half}};
}

// A light of this shader that stands `meters` from where it is to be right.
PunctualLight punctual_light(const UsedParams& p, double meters, double meter) {
    auto is = [&](const char* shader) { return is_library_shader(p.use, shader); };
    dvec3 color = p.color("lightcolor", 1);
    double most = std::max({color.x, color.y, color.z, 0.0});
    bool spot = is("collada_spot");
    PunctualLight light;
    if (is("collada_directional")) {
        light = punctual("directional", kPi * most, color, most);
        light.more = false;
    } else if (is("collada_point") || spot) {
        double a = attenuation(p, meters, meter);
        light = punctual(spot ? "spot" : "point", a > 0 ? kPi * most * meters * meters / a : 0.0,
                         color, most);
        if (spot) light.json["spot"] = collada_cone(p);
        light.beyond = "its attenuation (1 / d^2 comes near it)";
    } else if (is("gltf_directional")) {
        light = punctual("directional", p.number("intensity", 1) * most, color, most);
        light.more = false;
    } else if (is("gltf_point") || is("gltf_spot")) {
        spot = is("gltf_spot");
        light = punctual(spot ? "spot" : "point", p.number("intensity", 1) * most, color, most);
        if (double range = p.number("range", 0); range > 0) light.json["range"] = range;
        if (spot)
            light.json["spot"] = {{"innerConeAngle", p.number("inner_angle", 0)},
                                  {"outerConeAngle", p.number("outer_angle", kPi / 4)}};
        light.more = false;
    } else {
        light = punctual("point", 0, color, most);  // nothing of glTF's comes near
        if (is("collada_ambient")) light.beyond = "ambient light";
    }
    return light;
}

}  // namespace

// KHR_lights_punctual: lux and candela that give a Lambert surface what COLLADA's light gives it; a
// light whose fall-off is not 1 / d^2 does so at the centre of the scene's bounds.
uint32_t GltfExport::light(const LightDefinition& l, const dmat4& world) {
    use_extension("KHR_lights_punctual");
    const ShaderUse& use = l.shader;
    std::string name = fmt::format("light '{}'", l.id);
    double meters = glm::length(dvec3((axes_ * world)[3]) - bounds_centre_);
    PunctualLight light = punctual_light({use, description_.values}, meters, description_.meter);
    Json& result = light.json;
    if (!l.id.empty()) result["name"] = l.id;
    if (light.more && use.shader) {
        Json extras = rsl(use);  // in the file's own unit: kinora_axes tells it
        result["extras"]["kinora_rsl"]["light"] = extras;
        if (l.ambient) result["extras"]["kinora_rsl"]["ambient"] = true;
        if (l.shadows) result["extras"]["kinora_rsl"]["shadows"] = *l.shadows;
        in_extras(name, light.beyond, l.where);
    }
    for (const ParamSource& p : use.params)
        if (is_animated(p.value)) {
            lost(name, "its animated parameters", l.where);
            break;
        }
    json_["extensions"]["KHR_lights_punctual"]["lights"].push_back(result);
    return uint32_t(json_["extensions"]["KHR_lights_punctual"]["lights"].size() - 1);
}

}  // namespace kinora
