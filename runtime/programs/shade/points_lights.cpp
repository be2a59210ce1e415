// runtime/programs/shade/points_lights.cpp: lights of a file over positions.
#include "runtime/programs/shade/points_lights.h"

#include <fmt/format.h>

#include <algorithm>

#include "jit/ir/kernel_call.h"
#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/shade/points_host.h"
#include "runtime/scene/kernels/light_categories.h"

namespace kinora {

namespace {

const rsl::ShaderParameter* parameter_of(const rsl::Shader& shader, std::string_view name) {
    for (const rsl::ShaderParameter& parameter : shader.parameters)
        if (parameter.name == name) return &parameter;
    return nullptr;
}

float* filled(Arena& arena, size_t count, float value) {
    std::span<float> row = arena.allocate_span<float>(jit::padded(count));
    std::fill(row.begin(), row.end(), value);
    return row.data();
}

// A variable of the same type takes a parameter; any triple takes any.
bool takes_message(const rsl::ShaderParameter& parameter, rsl::Type type) {
    bool triples = rsl::is_triple(parameter.type.base) && rsl::is_triple(type.base);
    return (parameter.type.base == type.base || triples) &&
           parameter.type.array_length == type.array_length;
}

}  // namespace

std::optional<int> PointsLights::open(const ShadeOptions& options, const PointSet& points) {
    for (const PointsShader& from : points.document().lights) {
        Light& light = *lights_.emplace_back(std::make_unique<Light>());
        light.number = int32_t(lights_.size() - 1);
        light.from = &from;
        ShadeOptions own = options;
        own.source = from.file;
        own.shader = from.shader;
        for (const auto& [name, value] : from.parameters)
            light.source.params.push_back({name, value.numbers, value.texts});
        if (std::optional<int> code = compile_shade_source(own, light.source)) return code;
        const rsl::Shader* shader = choose_shader(own, light.source);
        if (!shader) return kExitUsage;
        if (shader->kind != rsl::ShaderKind::Light)
            throw PointsError(fmt::format("lights: '{}' of {} is a {} shader, not a light",
                                          shader->name, from.file,
                                          rsl::shader_kind_name(shader->kind)));
        PointsDocument alone;  // the points' variables are the surface's
        alone.count = points.count();
        light.stack.current_from_shader = from.current_from_shader;
        light.stack.layers = {bind_points_layer(
            *shader, 0, from.parameters, from.current_from_shader, alone, light.stack.numbers)};
        light.stack.lower.math = options.math;
    }
    return std::nullopt;
}

bool PointsLights::bind(const ShadeOptions& options, const rsl::LoweredShader& surface) {
    surface_ = &surface;
    for (auto& light : lights_) {
        light->stack.lower.messages = surface.light_messages;
        light->kernel = std::make_unique<PointsKernel>();
        bool ok = light->kernel->compile(light->stack, options.target, light->source.diagnostics);
        light->source.print_findings(options);
        if (!ok) return false;
    }
    return true;
}

std::optional<PointsValue> PointsLights::parameter(int32_t light, const std::string& name) const {
    if (light < 0 || size_t(light) >= lights_.size()) return std::nullopt;
    const Light& asked = *lights_[size_t(light)];
    auto own = asked.from->parameters.find(name);
    if (own != asked.from->parameters.end()) return own->second;
    const rsl::ShaderParameter* parameter =
        parameter_of(*asked.stack.layers[0].shader, name.c_str());
    if (!parameter || !parameter->constant) return std::nullopt;
    const auto& numbers = parameter->constant->numbers;
    const rsl::Type& type = parameter->type;
    PointsValue value{{}, {numbers.begin(), numbers.end()}, parameter->constant->strings};
    if (type.is_array()) value.lengths.push_back(size_t(type.array_length));
    return value;
}

double PointsLights::number(const Light& light, const char* name) const {
    auto own = light.from->parameters.find(name);
    if (own != light.from->parameters.end() && !own->second.numbers.empty())
        return own->second.numbers[0];
    const rsl::ShaderParameter* parameter = parameter_of(*light.stack.layers[0].shader, name);
    if (!parameter || !parameter->constant || parameter->constant->numbers.empty()) return 0;
    return double(parameter->constant->numbers[0]);
}

std::string PointsLights::category(const Light& light) const {
    auto own = light.from->parameters.find("__category");
    if (own != light.from->parameters.end() && own->second.is_text()) return own->second.texts[0];
    const rsl::ShaderParameter* parameter =
        parameter_of(*light.stack.layers[0].shader, "__category");
    bool known = parameter && parameter->constant && !parameter->constant->strings.empty();
    return known ? parameter->constant->strings[0] : "";
}

jit::RecordSet PointsLights::at_points(const PointSet& points, PointsHost& host, Arena& arena) {
    std::span<const float> rows[6];
    for (int c = 0; c < 3; ++c) {
        rows[c] = points.row(rsl::Global::P, c);
        rows[3 + c] = points.row(rsl::Global::N, c);
    }
    return run(points, rows, points.count(), 0, host, arena);
}

jit::RecordSet PointsLights::at_lanes(const PointSet& points, const jit::ServiceCall& call,
                                      PointsHost& host, Arena& arena) {
    size_t count = size_t(std::min<int32_t>(call.lanes, int32_t(points.count()) - call.first));
    std::span<const float> rows[6];
    for (size_t c = 0; c < 3; ++c) {
        std::span<float> P = arena.allocate_span<float>(jit::kMaxLanes);
        for (size_t i = 0; i < P.size(); ++i)
            P[i] = call.mask >> i & 1 ? call.args[c * jit::kMaxLanes + i] : 0.0f;
        rows[c] = P;
        rows[3 + c] = {filled(arena, jit::kMaxLanes, 0), jit::kMaxLanes};
    }
    return run(points, rows, count, size_t(call.first), host, arena);
}

jit::RecordSet PointsLights::run(const PointSet& points, const std::span<const float> (&rows)[6],
                                 size_t count, size_t first, PointsHost& host, Arena& arena) {
    if (running_) return {};
    running_ = true;
    std::vector<jit::Record> records;
    dmat4 surface_space = host.shader_space();
    for (auto& light : lights_) {
        const dmat4& space = light->stack.current_from_shader;
        host.set_shader_space(space);
        auto fill = [&](const rsl::KernelKey& key, std::span<float> row) {
            using rsl::Global;
            bool global = key.kind == rsl::KeyKind::Global && key.partial == rsl::Partial::None;
            Global id = global ? key.global() : Global::Count;
            bool normal = id == Global::N || id == Global::Ns;
            for (size_t i = 0; i < row.size(); ++i) {
                size_t at = std::min(i, count - 1);
                row[i] = id == Global::Ps  ? rows[key.component][at]
                         : normal          ? rows[3 + key.component][at]
                         : id == Global::P ? float(space[3][key.component])
                                           : points.frame_number(key, light->stack.numbers, space);
            }
        };
        const BoundKernel& bound = light->kernel->bound();
        bound.run_frame(light->kernel->frame(),
                        PointsFrameNumbers(points, light->stack, bound.pair), host);
        add_records(*light, light->kernel->run(count, fill, host, {}, arena), count, first, arena,
                    records);
    }
    host.set_shader_space(surface_space);
    running_ = false;
    std::span<jit::Record> kept = arena.allocate_span<jit::Record>(records.size());
    std::copy(records.begin(), records.end(), kept.begin());
    return {int32_t(kept.size()), kept.data()};
}

void PointsLights::add_records(const Light& light, std::span<float* const> out, size_t count,
                               size_t first, Arena& arena,
                               std::vector<jit::Record>& records) const {
    const rsl::Shader& shader = *light.stack.layers[0].shader;
    size_t messages = 0;
    for (int components : surface_->light_message_components) messages += size_t(components);
    const float* zeros = filled(arena, count, 0);
    auto row = [&](const rsl::KernelKey& key, const float* missing) -> const float* {
        int found = light.kernel->find_output(key);
        return found < 0 ? missing : out[size_t(found)];
    };
    for (size_t s = 0; s < light.kernel->lowered().light_statements.size(); ++s) {
        auto columns = arena.allocate_span<const float*>(rsl::kLightMessages + messages);
        std::fill(columns.begin(), columns.end(), zeros);
        for (size_t k = 0; k < 3; ++k)
            for (rsl::LightColumn column : {rsl::kLightL, rsl::kLightCl, rsl::kLightOl})
                columns[column + k] = row(rsl::light_key(s, column, int(k)), zeros);
        for (size_t k = 0; k < 3; ++k)  // no ray meets anything
            columns[rsl::kLightBare + k] = columns[rsl::kLightCl + k];
        columns[rsl::kLightLit] =
            row(rsl::light_key(s, rsl::kLightLit, 0), filled(arena, count, jit::float_of(1)));
        float* uniforms = filled(arena, rsl::kLightUniforms + surface_->light_messages.size(), 0);
        size_t next = rsl::kLightMessages;
        for (size_t m = 0; m < surface_->light_messages.size(); ++m) {
            rsl::Type type = surface_->light_message_types[m];
            const std::string& name = surface_->light_messages[m];
            const rsl::ShaderParameter* parameter = parameter_of(shader, name);
            bool known = parameter && takes_message(*parameter, type);
            uniforms[rsl::kLightUniforms + m] = jit::float_of(known);
            for (int e = 0; e < std::max(type.array_length, 1); ++e)
                for (int k = 0; k < rsl::component_count(type.base); ++k, ++next)
                    if (known)
                        columns[next] = row(rsl::message_key(name, type.is_array() ? e : -1,
                                                             rsl::form_of(parameter->type.base), k),
                                            zeros);
        }
        int32_t categories = 0;
        std::string own = category(light);
        for (size_t c = 0; c < surface_->categories.size(); ++c)
            categories |= int32_t(has_category(own, surface_->categories[c])) << c;
        uniforms[rsl::kLightKind] = jit::float_of(light.kernel->lowered().light_statements[s].kind);
        uniforms[rsl::kLightCategories] = jit::float_of(categories);
        uniforms[rsl::kLightNondiffuse] = float(number(light, "__nondiffuse"));
        uniforms[rsl::kLightNonspecular] = float(number(light, "__nonspecular"));
        uniforms[rsl::kLightNumber] = jit::float_of(light.number);
        uniforms[rsl::kLightHandle] = jit::float_of(int32_t(records.size()));
        for (const float*& column : columns) column -= first;
        records.push_back({columns.data(), uniforms});
    }
}

void PointsLights::report(const ShadeOptions& options) {
    for (auto& light : lights_) {
        if (light->kernel) light->kernel->report(light->source.diagnostics);
        light->source.print_findings(options);
    }
}

}  // namespace kinora
