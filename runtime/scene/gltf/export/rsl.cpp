// runtime/scene/gltf/export/rsl.cpp: shaders as extras.kinora_rsl.
#include "runtime/scene/gltf/export/rsl.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "collada/document/edit.h"
#include "rsl/link.h"
#include "runtime/scene/description/memory_file.h"
#include "runtime/scene/description/rsl_literals.h"
#include "runtime/scene/gltf/export/params.h"

namespace kinora {

namespace {

// One number, or a list of them; none leave the member as it is.
void set_numbers(Json& object, const std::string& name, std::span<const double> numbers) {
    if (numbers.size() == 1)
        object[name] = numbers[0];
    else if (!numbers.empty())
        object[name] = std::vector<double>(numbers.begin(), numbers.end());
}

// Vertex inputs of RSL parameters; import_gltf binds TEXCOORD_n by itself.
void add_inputs(const std::vector<VertexBinding>& bindings,
                const std::vector<GltfAttribute>& attributes, Json& result) {
    for (const VertexBinding& b : bindings)
        for (const GltfAttribute& a : attributes) {
            bool same = a.attribute->semantic == b.semantic &&
                        (b.set == kNone || b.set == a.attribute->set);
            if (!same) continue;
            if (a.name != b.param) result["inputs"][b.param] = a.name;
            break;
        }
}

struct StageRow {
    const char* name;
    std::vector<ShaderUse> MaterialDefinition::*uses;
};
constexpr StageRow kStages[] = {
    {"transformation", &MaterialDefinition::transformations},
    {"displacement", &MaterialDefinition::displacements},
    {"surface", &MaterialDefinition::surfaces},
    {"volume", &MaterialDefinition::interior},
    {"exterior", &MaterialDefinition::exterior},
    {"light", &MaterialDefinition::lights},
};

}  // namespace

Json RslWriter::shader(const ShaderUse& use) {
    if (!use.shader) return nullptr;
    Json result;
    if (is_library_shader(use, use.shader->name)) {
        result["library"] = use.shader->name;
    } else {
        result["code"] = code(*use.shader, 0);
        result["shader"] = use.shader->name;
    }
    Json params = Json::object();
    add_co_shaders(*use.shader, result, params);
    for (const ParamSource& p : use.params) {
        if (p.strings.empty())
            set_numbers(params, p.name, slot_values(description_, p.value));
        else
            set_strings(p, params);
    }
    if (!params.empty()) result["params"] = params;
    return result;
}

std::string RslWriter::code(const rsl::Shader& shader, size_t part) const {
    std::string code = rsl::portable_text(shader, part);
    if (link_) code = relinked_code(code, description_.pictures, link_);
    return collada::utf8_text(code);
}

// "coshaders" by handle, with the code of those that stand in another one; and the handles that
// parameters of type shader are bound to.
void RslWriter::add_co_shaders(const rsl::Shader& shader, Json& result, Json& params) const {
    for (size_t k : rsl::parts_to_keep(shader)) {
        const rsl::LinkedPart& part = shader.parts[k];
        std::string prefix = part.handle.empty() ? "" : part.handle + ".";
        for (const std::string& name : part.handle_parameters)
            params[prefix + name] = part.texts.at(name);
        if (k == 0) continue;
        Json& co_shader = result["coshaders"][part.handle];
        co_shader["shader"] = part.shader;
        if (part.text != shader.parts[0].text) co_shader["code"] = code(shader, k);
    }
}

// A texture where the one string names a file.
void RslWriter::set_strings(const ParamSource& p, Json& params) {
    std::string path = parse_texture_name(p.strings[0]).path;
    uint32_t index = kNone;
    if (p.strings.size() == 1 && textures_.has_file(path)) index = textures_.write(p.strings[0]);
    if (index != kNone) {
        TextureName name = parse_texture_name(p.strings[0]);
        params[p.name]["texture"] = index;
        if (name.data) params[p.name]["data"] = true;
        if (name.uv != TextureName().uv) params[p.name]["uv"] = name.uv;
        if (!fits_gltf_sampler(name)) params[p.name]["look"] = p.strings[0].substr(path.size() + 1);
    } else if (p.strings.size() == 1) {
        params[p.name] = p.strings[0];
    } else {
        params[p.name] = p.strings;
    }
}

Json RslWriter::stage(const std::vector<ShaderUse>& uses) {
    if (uses.size() == 1) return shader(uses[0]);
    Json list = Json::array();
    for (const ShaderUse& use : uses) list.push_back(shader(use));
    return list;
}

Json RslWriter::picture(const PictureShaders& picture) {
    Json result = Json::object();
    if (!picture.atmosphere.empty()) result["atmosphere"] = stage(picture.atmosphere);
    if (!picture.imagers.empty()) result["imagers"] = stage(picture.imagers);
    return result;
}

// A stage with what the use of its material binds.
Json RslWriter::bound_stage(const std::vector<ShaderUse>& uses, const MaterialUse& bound,
                            const PrimitiveGroup& group) {
    Json result = stage(uses);
    if (uses.size() != 1) return result;
    Json sets = Json::object();
    for (const ParamSource& p : uses[0].params)
        if (uint32_t set = p.texcoord.empty() ? 0 : texcoord_index(p.texcoord, bound, group))
            sets[p.name] = set;
    if (!sets.empty()) result["texcoords"] = sets;
    for (const auto& [name, slot] : bound.params)  // <bind semantic target>
        if (std::span<const double> numbers = slot_values(description_, slot); !numbers.empty())
            set_numbers(result["params"], name, numbers);
    return result;
}

Json RslWriter::material(const GltfLook& look, const PrimitiveGroup& group) {
    const MaterialDefinition& m = look.definition;
    Json result = Json::object();
    for (const StageRow& row : kStages)
        if (const auto& uses = m.*row.uses; !uses.empty())
            result[row.name] = bound_stage(uses, look.bound, group);
    if (result.contains("light") && m.light_samples) result["light_samples"] = m.light_samples;
    if (result.empty()) return result;
    add_inputs(look.bound.vertex_bindings, attributes_of(look, group, losses_), result);
    return result;
}

void RslWriter::move_stage(const std::string& pointer, const std::vector<ShaderUse>& uses) {
    if (uses.size() == 1) return move_shader(pointer, uses[0]);
    for (size_t layer = 0; layer < uses.size(); ++layer)
        move_shader(fmt::format("{}/{}", pointer, layer), uses[layer]);
}

void RslWriter::move_shader(const std::string& pointer, const ShaderUse& use) {
    for (const ParamSource& p : use.params)
        if (p.strings.empty() && find_source(use, p.name) == &p)
            motion_.move_numbers(fmt::format("{}/params/{}", pointer, p.name), p.value);
}

void RslWriter::move_picture(const std::string& pointer, const PictureShaders& picture) {
    move_stage(pointer + "/atmosphere", picture.atmosphere);
    move_stage(pointer + "/imagers", picture.imagers);
}

void RslWriter::move_material(const std::string& pointer, const GltfLook& look) {
    for (const StageRow& row : kStages) {
        std::vector<ShaderUse> uses = look.definition.*row.uses;
        const std::string own = fmt::format("{}/{}", pointer, row.name);
        if (uses.size() == 1)
            for (const auto& [name, slot] : look.bound.params) {  // they stand in place of others
                std::erase_if(uses[0].params, [&](const auto& p) { return p.name == name; });
                motion_.move_numbers(fmt::format("{}/params/{}", own, name), slot);
            }
        move_stage(own, uses);
    }
}

}  // namespace kinora
