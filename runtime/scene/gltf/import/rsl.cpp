// runtime/scene/gltf/import/rsl.cpp: extras.kinora_rsl: RSL shaders on what glTF has.
#include "runtime/scene/gltf/import/rsl.h"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "rsl/text/findings.h"
#include "runtime/base/file_extension.h"
#include "runtime/base/regular_file.h"
#include "runtime/base/text_encoding.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/description/texture_name.h"
#include "runtime/scene/gltf/file/json_scan.h"
#include "runtime/scene/gltf/file/value.h"
#include "runtime/scene/gltf/import/attribute_name.h"
#include "runtime/scene/gltf/import/values.h"
#include "runtime/scene/profile_rsl/effect_shaders.h"
#include "runtime/scene/profile_rsl/findings.h"

namespace kinora {

namespace {

constexpr uint64_t kMostSourceBytes = 64 << 20;

// A string is a file's name unless it holds code.
bool is_file_name(const std::string& text) {
    return text.find('\n') == std::string::npos && has_extension(text, {".sl"});
}

std::optional<bool> bool_member(const tinygltf::Value& object, const char* name) {
    const tinygltf::Value* value = member(object, name);
    if (!value || !value->IsBool()) return std::nullopt;
    return value->Get<bool>();
}

// Whether the parameter is one of type shader, or of a co-shader that is not called.
bool is_linked(const tinygltf::Value& layer, const rsl::Shader& shader, const std::string& name) {
    for (const rsl::Symbol* handle : shader.definition->handles)
        if (handle->name == name) return true;
    const tinygltf::Value* co_shaders = member(layer, "coshaders");
    size_t dot = name.find('.');
    return co_shaders && dot != name.npos && co_shaders->Has(name.substr(0, dot));
}

// "TEXCOORD_2" or "_HEAT" for a parameter.
VertexBinding vertex_input(const std::string& param, const std::string& semantic) {
    AttributeName name =
        semantic.starts_with('_') ? own_attribute(semantic) : numbered_attribute(semantic);
    if (name.name.empty()) return {param, semantic, kNone};
    return {param, name.name, name.set};
}

}  // namespace

PictureShaders RslExtras::picture_shaders(const tinygltf::Value& extras,
                                          const std::string& pointer) {
    PictureShaders picture;
    const tinygltf::Value* rsl = member(extras, "kinora_rsl");
    if (!rsl) return picture;
    std::string own = pointer + "/extras/kinora_rsl";
    picture.atmosphere = read_stage(*rsl, "atmosphere", rsl::ShaderKind::Volume, own);
    picture.imagers = read_stage(*rsl, "imagers", rsl::ShaderKind::Imager, own);
    return picture;
}

bool RslExtras::import_light(const tinygltf::Value& extras, const std::string& pointer,
                             LightDefinition& to) {
    const tinygltf::Value* rsl = member(extras, "kinora_rsl");
    if (!rsl) return false;
    std::vector<ShaderUse> uses =
        read_stage(*rsl, "light", rsl::ShaderKind::Light, pointer + "/extras/kinora_rsl");
    if (uses.empty()) return false;
    to.shader = std::move(uses.front());
    to.ambient = bool_member(*rsl, "ambient").value_or(false);
    if (std::optional<bool> shadows = bool_member(*rsl, "shadows")) to.shadows = *shadows;
    return true;
}

std::vector<VertexBinding> RslExtras::import_material(const tinygltf::Value& rsl,
                                                      const std::string& pointer,
                                                      MaterialDefinition& to) {
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
        std::vector<ShaderUse> uses = read_stage(rsl, row.name, row.kind, pointer);
        for (const ShaderUse& use : uses) shaders.push_back(use.shader.get());
        if (!uses.empty()) to.*row.stack = std::move(uses);
    }
    if (!any) report_.add(Code::GLTF_RSL, pointer, "it names no shader of a stage");
    std::vector<VertexBinding> bindings;
    if (const tinygltf::Value* inputs = member(rsl, "inputs"))
        for (const std::string& param : member_names(*inputs))
            bindings.push_back(vertex_input(param, string_member(*inputs, param.c_str())));
    const tinygltf::Value* params = member(rsl, "params");
    if (!params || shaders.empty()) return bindings;
    for (const std::string& key : member_names(*params))
        if (std::none_of(shaders.begin(), shaders.end(),
                         [&](const rsl::Shader* s) { return find_parameter(*s, key); }))
            report_unknown(*shaders.front(), key, pointer + "/params/" + key);
    return bindings;
}

// A stage is one layer or a list of them, bottom first.
std::vector<ShaderUse> RslExtras::read_stage(const tinygltf::Value& object, const char* stage,
                                             rsl::ShaderKind kind, const std::string& pointer) {
    std::vector<ShaderUse> uses;
    const tinygltf::Value* value = member(object, stage);
    if (!value) return uses;
    const SharedParams shared{member(object, "params"), pointer + "/params/"};
    auto add = [&](const tinygltf::Value& layer, const std::string& layer_pointer) {
        ShaderUse use = read_layer(layer, shared, kind, layer_pointer);
        if (use.shader) uses.push_back(std::move(use));
    };
    std::string own = pointer + "/" + stage;
    if (!value->IsArray()) add(*value, own);
    for (size_t i = 0; value->IsArray() && i < value->ArrayLen(); ++i)
        add(value->Get(int(i)), fmt::format("{}/{}", own, i));
    return uses;
}

// No shader where there is none of that kind.
ShaderUse RslExtras::read_layer(const tinygltf::Value& layer, const SharedParams& shared,
                                rsl::ShaderKind kind, const std::string& pointer) {
    ShaderUse use;
    const tinygltf::Value* co_shaders = member(layer, "coshaders");
    LayerCode code = read_code(layer, pointer);
    compile(code, !co_shaders);
    std::string name = string_member(layer, "shader");
    for (auto& shader : code.shaders)
        if (!use.shader && (name.empty() || shader->name == name))
            use.shader = as_kind(shader, kind);
    if (!use.shader) {
        if (!code.shaders.empty())
            diagnostics_.report(Code::RSL_SHADER_MISSING, report_.location(pointer),
                                rsl::shader_kind_name(kind),
                                name.empty() ? "" : fmt::format(" named '{}'", name));
        return use;
    }
    if (co_shaders || rsl::other_lengths(*use.shader, link_counts(layer, "")))
        use.shader = as_kind(linked(layer, co_shaders, code, *use.shader, pointer), kind);
    if (!use.shader) return use;
    set_params(layer, shared, pointer, use);
    if (const tinygltf::Value* sets = member(layer, "texcoords"))
        for (ParamSource& source : use.params)
            if (const tinygltf::Value* set = member(*sets, source.name.c_str()))
                if (set->IsNumber())
                    source.texcoord = fmt::format("TEXCOORD_{}", set->GetNumberAsInt());
    return use;
}

// What a layer's value holds: a file, code, or a shader of the program's own.
RslExtras::LayerCode RslExtras::read_code(const tinygltf::Value& layer,
                                          const std::string& pointer) {
    std::string text = layer.IsString() ? layer.Get<std::string>() : "";
    std::string file = is_file_name(text) ? text : string_member(layer, "file");
    std::string library = string_member(layer, "library");
    std::string code_pointer = layer.IsString() ? pointer : pointer + "/code";
    LayerCode code;
    if (!library.empty()) {
        if (auto shader = library_shader(library))
            code.shaders.push_back(std::move(shader));
        else
            report_.add(Code::GLTF_RSL, pointer,
                        fmt::format("there is no library shader '{}'", library));
    } else if (!file.empty()) {
        std::string path = gltf_path(file_, file);
        if (!may_read_gltf(file_, options_, path)) {
            report_.add(Code::GLTF_FILE, pointer, path, "it lies outside the scene's folder");
        } else if (std::optional<std::string> bytes = read_regular_file(path, kMostSourceBytes)) {
            code.text = utf8_text(std::move(*bytes));
            code.map.file = diagnostics_.files.add(path, code.text);
        } else {
            diagnostics_.report(rsl::Code::RSL_FILE_NOT_READ, Location{}, path);
        }
    } else if (std::optional<JsonRange> range = json_find(file_.json, code_pointer)) {
        code.text = json_string(file_.json, *range, file_.file, code.map);
    } else {
        report_.add(Code::GLTF_RSL, pointer, "it has no file, no code and no library");
    }
    return code;
}

// Where the shader is to be linked, that reports what is wrong: by itself it lacks the others.
void RslExtras::compile(LayerCode& code, bool report) {
    if (code.text.empty()) return;
    Diagnostics unheard;
    unheard.files = diagnostics_.files;
    Diagnostics& sink = report ? diagnostics_ : unheard;
    for (auto& shader : rsl::compile({code.text, code.map}, compile_options(), sink))
        code.shaders.push_back(std::move(shader));
    if (!report && code.shaders.empty())
        rsl::compile({code.text, code.map}, compile_options(), diagnostics_);
}

rsl::CompileOptions RslExtras::compile_options() const {
    rsl::CompileOptions options;
    options.include_directories = options_.include_directories;
    options.files = out_.readable;
    options.pictures = out_.pictures;
    return options;
}

// The texts of parameters that stand in "params" with this prefix.
rsl::LinkTexts RslExtras::link_texts(const tinygltf::Value& layer,
                                     const std::string& prefix) const {
    rsl::LinkTexts texts;
    const tinygltf::Value* params = member(layer, "params");
    if (!params) return texts;
    for (const std::string& key : member_names(*params)) {
        const tinygltf::Value& value = params->Get(key);
        std::string name = key.starts_with(prefix) ? key.substr(prefix.size()) : "";
        if (name.empty() || name.find('.') != name.npos) continue;
        if (value.IsString()) texts[name] = {value.Get<std::string>()};
        bool list = value.IsArray();
        for (size_t k = 0; list && k < value.ArrayLen(); ++k) list = value.Get(int(k)).IsString();
        for (size_t k = 0; list && k < value.ArrayLen(); ++k)
            texts[name].push_back(value.Get(int(k)).Get<std::string>());
    }
    return texts;
}

// How many numbers or texts they hold.
rsl::LinkCounts RslExtras::link_counts(const tinygltf::Value& layer,
                                       const std::string& prefix) const {
    rsl::LinkCounts counts;
    const tinygltf::Value* params = member(layer, "params");
    if (!params) return counts;
    for (const std::string& key : member_names(*params)) {
        std::string name = key.starts_with(prefix) ? key.substr(prefix.size()) : "";
        const tinygltf::Value& value = params->Get(key);
        std::vector<double> numbers;
        if (append_numbers(value, numbers))
            counts[name] = numbers.size();
        else
            counts[name] = value.IsArray() ? value.ArrayLen() : 1;
    }
    return counts;
}

// The shader with its "coshaders", each {"shader", "code" or "file"} by its handle; without code
// it stands in the shader's own. Null after an error.
std::shared_ptr<const rsl::Shader> RslExtras::linked(const tinygltf::Value& layer,
                                                     const tinygltf::Value* co_shaders,
                                                     const LayerCode& code,
                                                     const rsl::Shader& shader,
                                                     const std::string& pointer) {
    std::vector<rsl::LinkedSource> sources{
        {"", {code.text, code.map}, shader.name, link_texts(layer, ""), link_counts(layer, "")}};
    std::deque<LayerCode> kept;  // the sources are views
    for (const std::string& handle :
         co_shaders ? member_names(*co_shaders) : std::vector<std::string>()) {
        const tinygltf::Value& co_shader = co_shaders->Get(handle);
        const LayerCode* own = &code;
        if (member(co_shader, "code") || member(co_shader, "file"))
            own = &kept.emplace_back(read_code(co_shader, pointer + "/coshaders/" + handle));
        if (own->text.empty()) continue;  // reported
        sources.push_back({handle,
                           {own->text, own->map},
                           string_member(co_shader, "shader"),
                           link_texts(layer, handle + "."),
                           link_counts(layer, handle + ".")});
    }
    return rsl::compile_linked(sources, compile_options(), diagnostics_);
}

// Those of the layer itself, then those of all layers that this shader has.
void RslExtras::set_params(const tinygltf::Value& layer, const SharedParams& shared,
                           const std::string& pointer, ShaderUse& use) {
    if (const tinygltf::Value* own = member(layer, "params"))
        for (const std::string& key : member_names(*own)) {
            std::string param_pointer = pointer + "/params/" + key;
            if (find_parameter(*use.shader, key))
                set_param(use, key, own->Get(key), param_pointer);
            else if (!is_linked(layer, *use.shader, key))
                report_unknown(*use.shader, key, param_pointer);
        }
    if (shared.values)
        for (const std::string& key : member_names(*shared.values))
            if (find_parameter(*use.shader, key))
                set_param(use, key, shared.values->Get(key), shared.pointer + key);
}

void RslExtras::set_param(ShaderUse& use, const std::string& name, const tinygltf::Value& value,
                          const std::string& pointer) {
    const rsl::ShaderParameter& parameter = *find_parameter(*use.shader, name);
    ParamSource source;
    source.name = name;
    source.where = report_.location(pointer);
    auto refuse = [&](const std::string& what) {
        report_.add(Code::RSL_BIND_TYPE, pointer, name, rsl::type_name(parameter.type), what);
    };
    if (parameter.type.base == rsl::BaseType::String) {
        if (!read_strings(value, pointer, source))
            return refuse("what is no string and no texture");
        if (size_t needed = size_t(std::max(parameter.type.array_length, 1));
            source.strings.size() != needed)
            return refuse(fmt::format("{} strings", source.strings.size()));
    } else {
        std::vector<double> numbers;
        if (!append_numbers(value, numbers) || numbers.empty()) return refuse("what is no number");
        uint32_t needed = uint32_t(rsl::component_count(parameter.type.base)) *
                          uint32_t(std::max(parameter.type.array_length, 1));
        bool fits = numbers.size() == needed || (numbers.size() == 1 && needed == 3);
        if (!fits) return refuse(fmt::format("{} numbers", numbers.size()));
        source.value = {append_values(out_.values, numbers, numbers.size()),
                        uint32_t(numbers.size())};
        pointers_.follow({pointer, numbers}, {source.value});
    }
    use.params.push_back(std::move(source));
}

// Strings, paths of files that may be read, textures, or a list of these; false for other values.
bool RslExtras::read_strings(const tinygltf::Value& value, const std::string& pointer,
                             ParamSource& source) {
    if (value.IsArray()) {
        for (size_t k = 0; k < value.ArrayLen(); ++k) {
            const tinygltf::Value& item = value.Get(int(k));
            if (item.IsArray() || !read_strings(item, fmt::format("{}/{}", pointer, k), source))
                return false;
        }
        return value.ArrayLen() > 0;
    }
    if (value.IsString()) {
        std::string text = value.Get<std::string>();
        std::string path = gltf_path(file_, text);
        bool allowed = out_.pictures.contains(path);
        bool is_file = is_regular_file(path);
        if (is_file && !allowed)
            report_.add(Code::GLTF_FILE, pointer, path, "it lies outside the scene's folder");
        source.strings.push_back(is_file && allowed ? out_.pictures.name_of(path) : text);
        return true;
    }
    const tinygltf::Value* texture = member(value, "texture");
    if (!texture || !texture->IsNumber()) return false;
    source.strings.push_back(texture_of(value, texture->GetNumberAsInt(), pointer));
    return true;
}

// A texture's name with what the writer's name held beside its path (texture_name.h).
std::string RslExtras::texture_of(const tinygltf::Value& value, int texture,
                                  const std::string& pointer) {
    bool is_data = bool_member(value, "data").value_or(false);
    if (!has_index(texture, file_.model.textures.size()))
        report_.add(Code::GLTF_REFERENCE, pointer, "texture", texture);
    std::string name = textures_.texture_name(texture, is_data);
    if (name.empty()) return name;
    const tinygltf::Value* look = member(value, "look");
    if (look && look->IsString()) {
        std::string path = parse_texture_name(name).path;
        name = texture_name_string(parse_texture_name(path + '\x1f' + look->Get<std::string>()));
    }
    std::vector<double> uv;
    const tinygltf::Value* uv_value = member(value, "uv");  // TextureName::uv
    if (uv_value && append_numbers(*uv_value, uv) && uv.size() == 4) {
        TextureName parsed = parse_texture_name(name);
        std::copy(uv.begin(), uv.end(), parsed.uv.begin());
        name = texture_name_string(parsed);
    }
    return name;
}

void RslExtras::report_unknown(const rsl::Shader& shader, const std::string& name,
                               const std::string& pointer) {
    Finding* finding = report_.add(Code::RSL_BIND_UNKNOWN, pointer, shader.name, name);
    if (!finding) return;
    std::vector<std::string_view> names;
    for (const auto& p : shader.parameters) names.push_back(p.name);
    if (std::string_view near = nearest_name(name, names); !near.empty())
        finding->help = fmt::format("did you mean '{}'?", near);
}

}  // namespace kinora
