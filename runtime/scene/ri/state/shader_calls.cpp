// runtime/scene/ri/state/shader_calls.cpp: shaders and lights of the current attributes.
#include <algorithm>
#include <glm/matrix.hpp>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/ri/state/layer_links.h"
#include "runtime/scene/ri/state/shader_calls.h"

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

rsl::CompileOptions compile_options(const ImportOptions& import) {
    rsl::CompileOptions options;
    options.include_directories = import.include_directories;
    return options;
}

}  // namespace

ShaderCalls::ShaderCalls(State& state, StateReport& report, Diagnostics& diagnostics)
    : state_(state),
      report_(report),
      search_(compile_options(state.import), state.path.substr(0, state.path.rfind('/') + 1),
              diagnostics),
      linker_(search_, diagnostics) {}

bool ShaderCalls::call(const Call& call) {
    using R = Request;
    using C = ShaderCalls;
    static const Handlers<C> kHandlers = {
        {R::LightSource, &C::light_source},
        {R::AreaLightSource, &C::light_source},
        {R::Illuminate, &C::illuminate},
        {R::Surface, &C::surface},
        {R::Displacement, &C::surface},
        {R::Deformation, &C::surface},
        {R::Atmosphere, &C::surface},
        {R::Interior, &C::surface},
        {R::Exterior, &C::surface},
        {R::ShaderLayer, &C::shader_layer},
        {R::ConnectShaderLayers, &C::connect_layers},
        {R::Shader, &C::co_shader},
        {R::MakeTexture, &C::make_map},
        {R::MakeBump, &C::make_map},
        {R::MakeLatLongEnvironment, &C::make_map},
        {R::MakeCubeFaceEnvironment, &C::make_cube_map},
        {R::MakeShadow, &C::make_shadow},
    };
    return kHandlers.call(*this, call);
}

std::vector<std::string> ShaderCalls::folders(std::string_view kind) const {
    std::string own = state_.path.substr(0, state_.path.rfind('/') + 1);
    std::vector<std::string> all;
    auto found = state_.options.search_paths.find(kind);
    if (found != state_.options.search_paths.end())
        for (std::string folder : found->second) {
            if (!folder.ends_with('/')) folder += '/';
            if (!folder.starts_with('/')) all.push_back(own + folder);
            all.push_back(std::move(folder));
        }
    all.push_back(own);
    if (!own.empty()) all.push_back("");
    return all;
}

std::shared_ptr<const rsl::Shader> ShaderCalls::find(std::string_view name) {
    return names_nothing(name) ? nullptr : search_.find(name, folders("shader"));
}

ShaderBinding ShaderCalls::binding_of(const Call& call, std::shared_ptr<const rsl::Shader> shader) {
    ShaderBinding made{std::move(shader), {}, state_.to_camera(), call.where, "", {}};
    for (const Parameter& p : call.parameters) {
        ShaderArgument argument{std::string(p.name), p.declaration.type, {}, {}};
        for (const char* text : p.values.strings())
            argument.strings.push_back(map_name(p.name, text, *made.shader));
        if (p.declaration.type == Type::Color && !state_.options.to_rgb.empty()) {
            dvec3 color = rgb_of(p.values, state_.options);
            argument.numbers = {color.x, color.y, color.z};
        } else {
            for (float number : p.values.floats()) argument.numbers.push_back(double(number));
            for (int number : p.values.integers()) argument.numbers.push_back(number);
        }
        made.arguments.push_back(std::move(argument));
    }
    if (call.request == Request::ShaderLayer) made.layer = call.arguments[2].string();
    if (call.request != Request::Shader) linker_.link(made, state_.attributes.co_shaders);
    return made;
}

// Once a name: that no shader has it, or why the one that has it is not used. `found`: a shader of
// another kind.
void ShaderCalls::report_unusable(std::string_view kind, std::string_view name,
                                  const rsl::Shader* found, std::string_view instead) {
    if (!report_.is_new(fmt::format("shader {} {}", kind, name))) return;
    const std::string file = search_.file_of(name, folders("shader"));
    if (!found && file.empty()) return report_.add(Code::RI_SHADER_UNKNOWN, kind, name, instead);
    const std::string why =
        found ? fmt::format("it is a {} shader", rsl::shader_kind_name(found->kind))
              : fmt::format("'{}' does not compile", file);
    report_.add(Code::RI_SHADER_REFUSED, kind, name, why, instead);
}

// Null: the name is that of no shader, or of one that does nothing.
Binding ShaderCalls::bind(const Call& call, size_t name_at, std::string_view kind) {
    std::string_view name = call.arguments[name_at].string();
    if (names_nothing(name)) return nullptr;
    std::shared_ptr<const rsl::Shader> shader = find(name);
    if (!shader || shader->kind != kind_of(kind)) {
        report_unusable(kind, name, shader.get(),
                        kind == "surface" ? "the default surface stands for it" : "it is left out");
        return nullptr;
    }
    return std::make_shared<const ShaderBinding>(binding_of(call, std::move(shader)));
}

// Null: of no such type; calls are refused for that (calls/accepted_tokens.cpp).
std::vector<Binding>* ShaderCalls::layers_of(std::string_view type) {
    for (const ShaderRow& row : kShaders)
        if (row.type == type) return &(state_.attributes.*row.layers);
    return nullptr;
}

void ShaderCalls::surface(const Call& call) {
    auto row = std::ranges::find(kShaders, call.request, &ShaderRow::request);
    std::vector<Binding>& layers = state_.attributes.*row->layers;
    layers.clear();
    if (Binding made = bind(call, 0, row->type)) layers.push_back(std::move(made));
    if (call.request == Request::Surface)
        state_.attributes.no_surface = call.arguments[0].string() == "null";
}

void ShaderCalls::shader_layer(const Call& call) {
    std::vector<Binding>* layers = layers_of(call.arguments[0].string());
    if (!layers) return;
    if (Binding made = bind(call, 1, call.arguments[0].string()))
        layers->push_back(std::move(made));
}

void ShaderCalls::connect_layers(const Call& call) {
    std::vector<Binding>* layers = layers_of(call.arguments[0].string());
    if (!layers) return;
    const std::string why =
        connect(*layers, {call.arguments[1].string(), call.arguments[2].string()},
                {call.arguments[3].string(), call.arguments[4].string()});
    if (!why.empty()) report_.add(Code::RI_RANGE, "ConnectShaderLayers", why);
}

// One of a handle that is there already replaces that.
void ShaderCalls::co_shader(const Call& call) {
    std::string_view name = call.arguments[0].string();
    std::string handle(call.arguments[1].string());
    if (handle.empty() || handle.find_first_of(".,") != handle.npos)
        return report_.add(Code::RI_RANGE, "Shader", "a handle is a text without dots and commas");
    std::vector<CoShader>& all = state_.attributes.co_shaders;
    std::erase_if(all, [&](const CoShader& other) { return other.handle == handle; });
    std::shared_ptr<const rsl::Shader> shader = find(name);
    if (shader)
        all.push_back({std::move(handle),
                       std::make_shared<const ShaderBinding>(binding_of(call, std::move(shader)))});
    else
        report_unusable("linked", name, nullptr, "it is left out");
}

// Null: no light of that name was found.
Light ShaderCalls::light_of(const Call& call) {
    std::string_view name = call.arguments[0].string();
    std::shared_ptr<const rsl::Shader> shader = find(name);
    if (!shader || shader->kind != rsl::ShaderKind::Light) {
        if (!names_nothing(name)) report_unusable("light", name, shader.get(), "it is left out");
        return nullptr;
    }
    auto made = std::make_shared<LightBinding>();
    made->shader = binding_of(call, std::move(shader));
    made->number = call.arguments[1].integer();
    made->shadows = state_.attributes.light_shadows;
    made->samples = state_.attributes.light_samples;
    made->area = call.request == Request::AreaLightSource;
    return made;
}

void ShaderCalls::light_source(const Call& call) {
    Light made = light_of(call);
    if (call.request == Request::AreaLightSource) state_.attributes.area_light = made;
    if (!made) return;
    lights_[made->number] = made;
    state_.attributes.lights.push_back(std::move(made));
}

void ShaderCalls::illuminate(const Call& call) {
    auto found = lights_.find(call.arguments[0].integer());
    if (found == lights_.end()) return;  // one that was left out, as was said
    std::erase(state_.attributes.lights, found->second);
    if (call.arguments[1].integer()) state_.attributes.lights.push_back(found->second);
}

}  // namespace kinora::ri
