// runtime/scene/ri/state/shaders.cpp: shaders and lights of the current attributes.
#include <algorithm>
#include <glm/matrix.hpp>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/state/interpreter.h"

namespace kinora::ri {
namespace {

// What requests call the shaders that they bind.
struct ShaderRow {
    Request request;
    std::string_view type;
    rsl::ShaderKind kind;
    std::vector<Binding> Attributes::*layers;
};
const ShaderRow kShaders[] = {
    {Request::Surface, "surface", rsl::ShaderKind::Surface, &Attributes::surfaces},
    {Request::Displacement, "displacement", rsl::ShaderKind::Displacement,
     &Attributes::displacements},
    {Request::Deformation, "deformation", rsl::ShaderKind::Transformation,
     &Attributes::deformations},
    {Request::Atmosphere, "atmosphere", rsl::ShaderKind::Volume, &Attributes::atmospheres},
    {Request::Interior, "interior", rsl::ShaderKind::Volume, &Attributes::interiors},
    {Request::Exterior, "exterior", rsl::ShaderKind::Volume, &Attributes::exteriors},
};

rsl::ShaderKind kind_of(std::string_view type) {
    for (const ShaderRow& row : kShaders)
        if (row.type == type) return row.kind;
    return type == "imager" ? rsl::ShaderKind::Imager : rsl::ShaderKind::Light;
}

bool names_nothing(std::string_view name) {
    return name.empty() || name == "null";
}

}  // namespace

std::vector<std::string> Interpreter::folders(std::string_view kind) const {
    std::string own = path_.substr(0, path_.rfind('/') + 1);
    std::vector<std::string> all;
    auto found = options_.search_paths.find(kind);
    if (found != options_.search_paths.end())
        for (std::string folder : found->second) {
            if (!folder.ends_with('/')) folder += '/';
            if (!folder.starts_with('/')) all.push_back(own + folder);
            all.push_back(std::move(folder));
        }
    all.push_back(own);
    if (!own.empty()) all.push_back("");
    return all;
}

std::shared_ptr<const rsl::Shader> Interpreter::find_shader(std::string_view name) {
    return names_nothing(name) ? nullptr : shaders_.find(name, folders("shader"));
}

ShaderBinding Interpreter::binding_of(const Call& call, std::shared_ptr<const rsl::Shader> shader) {
    ShaderBinding made{std::move(shader), {}, to_camera(), call.where};
    for (const Parameter& p : call.parameters) {
        ShaderArgument argument{std::string(p.name), {}, {}};
        for (const char* text : p.values.strings())
            argument.strings.push_back(map_name(p.name, text, *made.shader));
        if (p.declaration.type == Type::Color && !options_.to_rgb.empty()) {
            dvec3 color = rgb(p.values);
            argument.numbers = {color.x, color.y, color.z};
        } else {
            for (float number : p.values.floats()) argument.numbers.push_back(double(number));
            for (int number : p.values.integers()) argument.numbers.push_back(number);
        }
        made.arguments.push_back(std::move(argument));
    }
    return made;
}

// Null: the name is that of no shader, or of one that does nothing.
Binding Interpreter::bind(const Call& call, size_t name_at, std::string_view kind) {
    std::string_view name = call.arguments[name_at].string();
    if (names_nothing(name)) return nullptr;
    std::shared_ptr<const rsl::Shader> shader = find_shader(name);
    bool fits = shader && shader->kind == kind_of(kind);
    if (!fits) {
        std::string_view instead =
            kind == "surface" ? "the default surface stands for it" : "it is left out";
        if (told_.insert(fmt::format("shader {} {}", kind, name)).second)
            report(Code::RI_SHADER_UNKNOWN, kind, name, instead);
        return nullptr;
    }
    return std::make_shared<const ShaderBinding>(binding_of(call, std::move(shader)));
}

std::vector<Binding>* Interpreter::layers_of(std::string_view type) {
    for (const ShaderRow& row : kShaders)
        if (row.type == type) return &(attributes_.*row.layers);
    return nullptr;
}

void Interpreter::surface(const Call& call) {
    auto row = std::ranges::find(kShaders, call.request, &ShaderRow::request);
    std::vector<Binding>& layers = attributes_.*row->layers;
    layers.clear();
    if (Binding made = bind(call, 0, row->type)) layers.push_back(std::move(made));
    if (call.request == Request::Surface) {
        attributes_.area_light = nullptr;
        attributes_.no_surface = call.arguments[0].string() == "null";
    }
}

void Interpreter::shader_layer(const Call& call) {
    std::vector<Binding>* layers = layers_of(call.arguments[0].string());
    if (!layers) return report(Code::RI_RANGE, "ShaderLayer", "there is no such type of shaders");
    if (Binding made = bind(call, 1, call.arguments[0].string()))
        layers->push_back(std::move(made));
}

void Interpreter::co_shader(const Call& call) {
    not_done(call.request == Request::Shader ? "Shader" : "ConnectShaderLayers",
             "shaders are bound one by one");
}

void Interpreter::light_source(const Call& call) {
    std::string_view name = call.arguments[0].string();
    int number = call.arguments[1].integer();
    std::shared_ptr<const rsl::Shader> shader = find_shader(name);
    if (!shader || shader->kind != rsl::ShaderKind::Light) {
        if (!names_nothing(name)) report(Code::RI_SHADER_UNKNOWN, "light", name, "it is left out");
        return;
    }
    auto made = std::make_shared<LightBinding>();
    made->shader = binding_of(call, std::move(shader));
    made->number = number;
    made->shadows = attributes_.light_shadows;
    made->samples = attributes_.light_samples;
    lights_[number] = made;
    attributes_.lights.push_back(made);
}

void Interpreter::area_light_source(const Call& call) {
    attributes_.area_light = nullptr;
    std::string_view name = call.arguments[0].string();
    std::shared_ptr<const rsl::Shader> shader = find_shader(name);
    if (!shader || shader->kind != rsl::ShaderKind::Light) {
        if (!names_nothing(name)) report(Code::RI_SHADER_UNKNOWN, "light", name, "it is left out");
        return;
    }
    auto made = std::make_shared<LightBinding>();
    made->shader = binding_of(call, std::move(shader));
    made->number = call.arguments[1].integer();
    made->shadows = attributes_.light_shadows;
    made->samples = attributes_.light_samples;
    attributes_.area_light = made;
}

void Interpreter::illuminate(const Call& call) {
    auto found = lights_.find(call.arguments[0].integer());
    if (found == lights_.end()) return;  // one that was left out, as was said
    std::erase(attributes_.lights, found->second);
    if (call.arguments[1].integer()) attributes_.lights.push_back(found->second);
}

}  // namespace kinora::ri
