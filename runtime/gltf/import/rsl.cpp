// runtime/gltf/import/rsl.cpp: a material's extras.kinora_rsl: RSL shaders on a glTF material.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "runtime/description/findings.h"
#include "runtime/description/shader_library.h"
#include "runtime/description/texture_name.h"
#include "runtime/gltf/import/import_p.h"
#include "runtime/gltf/file/json_scan.h"
#include "runtime/profile_rsl/effect_shaders.h"
#include "runtime/profile_rsl/findings.h"

namespace kinora {

namespace {

const tinygltf::Value* member(const tinygltf::Value& object, const char* name) {
    return object.IsObject() && object.Has(name) ? &object.Get(name) : nullptr;
}

std::string text_of(const tinygltf::Value& object, const char* name) {
    const tinygltf::Value* value = member(object, name);
    return value && value->IsString() ? value->Get<std::string>() : "";
}

// Numbers of a number, an array of numbers, or arrays within it.
bool numbers_of(const tinygltf::Value& value, std::vector<double>& numbers) {
    if (value.IsNumber()) {
        numbers.push_back(value.GetNumberAsDouble());
        return true;
    }
    if (!value.IsArray()) return false;
    for (size_t i = 0; i < value.ArrayLen(); ++i)
        if (!numbers_of(value.Get(int(i)), numbers)) return false;
    return true;
}

std::vector<std::string> keys_of(const tinygltf::Value& value) {
    return value.IsObject() ? value.Keys() : std::vector<std::string>();
}

// A string is a file's name unless it holds code.
bool is_file_name(const std::string& text) {
    return text.ends_with(".sl") && text.find('\n') == std::string::npos;
}

}  // namespace

void GltfImport::set_rsl_param(ShaderUse& use, const std::string& name,
                               const tinygltf::Value& value, const std::string& pointer) {
    const rsl::ShaderParameter* parameter = find_parameter(*use.shader, name);
    if (!parameter) return;  // of another stage, or told by the caller
    ParamSource source;
    source.name = name;
    source.where = gltf_location(file_, pointer);
    auto refuse = [&](const std::string& what) {
        if (++findings_ <= kMaxGltfFindings)
            diagnostics_
                .report(Code::RSL_BIND_TYPE, source.where, name, rsl::type_name(parameter->type),
                        what)
                .id_path = pointer;
    };
    if (parameter->type.base == rsl::BaseType::String) {
        const tinygltf::Value* texture = member(value, "texture");
        if (value.IsString()) {
            std::string text = value.Get<std::string>();
            std::string path = gltf_path(file_, text);
            bool is_own = may_read_gltf(file_, options_, path);
            std::error_code code;
            bool is_file = !path.empty() && std::filesystem::is_regular_file(path, code);
            if (is_file && !is_own)
                report(Code::GLTF_FILE, pointer, path, "it lies outside the scene's folder");
            source.strings = {is_file && is_own ? path : text};
        } else if (texture && texture->IsNumber()) {
            const tinygltf::Value* data = member(value, "data");
            bool is_data = data && data->IsBool() && data->Get<bool>();
            source.strings = {texture_string(texture->GetNumberAsInt(), is_data, pointer)};
            // What the writer's texture name held beside its path (texture_name.h).
            const tinygltf::Value* look = member(value, "look");
            if (look && look->IsString() && !source.strings[0].empty()) {
                std::string path = parse_texture_name(source.strings[0]).path;
                source.strings[0] = texture_name_string(
                    parse_texture_name(path + '\x1f' + look->Get<std::string>()));
            }
            std::vector<double> uv;
            const tinygltf::Value* placed = member(value, "uv");  // TextureName::uv
            if (placed && numbers_of(*placed, uv) && uv.size() == 4 && !source.strings[0].empty()) {
                TextureName texture_name = parse_texture_name(source.strings[0]);
                std::copy(uv.begin(), uv.end(), texture_name.uv.begin());
                source.strings[0] = texture_name_string(texture_name);
            }
        } else {
            return refuse("what is no string and no texture");
        }
    } else {
        std::vector<double> numbers;
        if (!numbers_of(value, numbers) || numbers.empty()) return refuse("what is no number");
        uint32_t needed = uint32_t(rsl::component_count(parameter->type.base)) *
                          uint32_t(std::max(parameter->type.array_length, 1));
        bool fits = numbers.size() == needed || (numbers.size() == 1 && needed == 3);
        if (!fits) return refuse(fmt::format("{} numbers", numbers.size()));
        source.value = {append(numbers, numbers.size()), uint32_t(numbers.size())};
    }
    use.params.push_back(std::move(source));
}

// The shaders that a stage's value holds: of a file, of code, or one of the program's own.
std::vector<std::shared_ptr<const rsl::Shader>> GltfImport::rsl_shaders(
    const tinygltf::Value& stage, const std::string& pointer) {
    std::string text = stage.IsString() ? stage.Get<std::string>() : "";
    std::string file = is_file_name(text) ? text : text_of(stage, "file");
    std::string library = text_of(stage, "library");
    std::string code_pointer = stage.IsString() ? pointer : pointer + "/code";
    rsl::CompileOptions options;
    options.include_directories = options_.include_directories;
    options.files = out_.readable;
    std::vector<std::shared_ptr<const rsl::Shader>> shaders;
    auto take = [&](auto compiled) {
        for (auto& shader : compiled) shaders.push_back(std::move(shader));
    };
    if (!library.empty()) {
        if (auto shader = library_shader(library, diagnostics_))
            shaders.push_back(std::move(shader));
        else
            report(Code::GLTF_RSL, pointer,
                   fmt::format("there is no library shader '{}'", library));
    } else if (!file.empty()) {
        std::string path = gltf_path(file_, file);
        if (may_read_gltf(file_, options_, path))
            take(rsl::compile_file(path, options, diagnostics_));
        else
            report(Code::GLTF_FILE, pointer, path, "it lies outside the scene's folder");
    } else if (std::optional<JsonRange> range = json_find(file_.json, code_pointer)) {
        rsl::ShaderSource source;
        std::string code = json_string(file_.json, *range, file_.file, source.map);
        source.text = code;
        take(rsl::compile(source, options, diagnostics_));
    } else {
        report(Code::GLTF_RSL, pointer, "it has no file, no code and no library");
    }
    return shaders;
}

void GltfImport::unknown_param(const rsl::Shader& shader, const std::string& name,
                               const std::string& pointer) {
    if (++findings_ > kMaxGltfFindings) return;
    std::vector<std::string_view> names;
    for (const auto& p : shader.parameters) names.push_back(p.name);
    Finding& finding = diagnostics_.report(Code::RSL_BIND_UNKNOWN, gltf_location(file_, pointer),
                                           shader.name, name);
    finding.id_path = pointer;
    if (std::string_view near = nearest_name(name, names); !near.empty())
        finding.help = fmt::format("did you mean '{}'?", near);
}

// One layer; no shader where there is none of that kind.
ShaderUse GltfImport::rsl_use(const tinygltf::Value& stage, const tinygltf::Value* params,
                              rsl::ShaderKind kind, const std::string& pointer) {
    ShaderUse use;
    std::string name = text_of(stage, "shader");
    auto shaders = rsl_shaders(stage, pointer);
    for (auto& shader : shaders)
        if (!use.shader && shader->kind == kind && (name.empty() || shader->name == name))
            use.shader = shader;
    if (!use.shader) {
        if (!shaders.empty())
            diagnostics_.report(Code::RSL_SHADER_MISSING, gltf_location(file_, pointer),
                                rsl::shader_kind_name(kind),
                                name.empty() ? "" : fmt::format(" named '{}'", name));
        return use;
    }
    if (const tinygltf::Value* own = member(stage, "params"))
        for (const std::string& key : keys_of(*own)) {
            std::string place = pointer + "/params/" + key;
            if (find_parameter(*use.shader, key))
                set_rsl_param(use, key, own->Get(key), place);
            else
                unknown_param(*use.shader, key, place);
        }
    if (params)
        for (const std::string& key : keys_of(*params))
            if (find_parameter(*use.shader, key))
                set_rsl_param(use, key, params->Get(key), pointer + "/params/" + key);
    if (const tinygltf::Value* sets = member(stage, "texcoords"))
        for (ParamSource& source : use.params)
            if (const tinygltf::Value* set = member(*sets, source.name.c_str()))
                if (set->IsNumber())
                    source.texcoord = fmt::format("TEXCOORD_{}", set->GetNumberAsInt());
    return use;
}

// A stage is one layer or a list of them, bottom first.
std::vector<ShaderUse> GltfImport::rsl_stage(const tinygltf::Value& object, const char* stage,
                                             rsl::ShaderKind kind, const std::string& pointer) {
    std::vector<ShaderUse> uses;
    const tinygltf::Value* value = member(object, stage);
    if (!value) return uses;
    const tinygltf::Value* params = member(object, "params");
    auto add = [&](const tinygltf::Value& layer, const std::string& place) {
        ShaderUse use = rsl_use(layer, params, kind, place);
        if (use.shader) uses.push_back(std::move(use));
    };
    std::string place = pointer + "/" + stage;
    if (!value->IsArray()) add(*value, place);
    for (size_t i = 0; value->IsArray() && i < value->ArrayLen(); ++i)
        add(value->Get(int(i)), fmt::format("{}/{}", place, i));
    return uses;
}

void GltfImport::import_rsl(uint32_t index) {
    const tinygltf::Value& rsl = model_.materials[index].extras.Get("kinora_rsl");
    std::string pointer = fmt::format("/materials/{}/extras/kinora_rsl", index);
    MaterialDefinition& to = out_.materials[index];
    struct Row {
        const char* name;
        rsl::ShaderKind kind;
        std::vector<ShaderUse> MaterialDefinition::*stack;
    };
    constexpr Row kRows[] = {
        {"surface", rsl::ShaderKind::Surface, &MaterialDefinition::surfaces},
        {"displacement", rsl::ShaderKind::Displacement, &MaterialDefinition::displacements},
        {"transformation", rsl::ShaderKind::Transformation, &MaterialDefinition::transformations},
        {"volume", rsl::ShaderKind::Volume, &MaterialDefinition::interior},
        {"exterior", rsl::ShaderKind::Volume, &MaterialDefinition::exterior},
        {"light", rsl::ShaderKind::Light, &MaterialDefinition::lights},
    };
    bool any = false;
    std::vector<const rsl::Shader*> shaders;
    for (const Row& row : kRows) {
        any |= member(rsl, row.name) != nullptr;
        std::vector<ShaderUse> uses = rsl_stage(rsl, row.name, row.kind, pointer);
        for (const ShaderUse& use : uses) shaders.push_back(use.shader.get());
        if (!uses.empty()) to.*row.stack = std::move(uses);
    }
    if (!any) report(Code::GLTF_RSL, pointer, "it names no shader of a stage");
    if (const tinygltf::Value* inputs = member(rsl, "inputs"))
        for (const std::string& param : keys_of(*inputs)) {
            std::string semantic = text_of(*inputs, param.c_str());
            Numbered of_set =
                semantic.starts_with('_') ? own_attribute(semantic) : numbered(semantic);
            inputs_[index].push_back({param, of_set.name.empty() ? semantic : of_set.name,
                                      of_set.name.empty() ? kNone : of_set.set});
        }
    const tinygltf::Value* params = member(rsl, "params");
    if (!params || shaders.empty()) return;
    for (const std::string& key : keys_of(*params))
        if (std::none_of(shaders.begin(), shaders.end(),
                         [&](const rsl::Shader* s) { return find_parameter(*s, key); }))
            unknown_param(*shaders.front(), key, pointer + "/params/" + key);
}

}  // namespace kinora
