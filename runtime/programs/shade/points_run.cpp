// runtime/programs/shade/points_run.cpp: `run --points`: shaders over points of a file, numbers
// out.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/shade/co_shaders.h"
#include "runtime/programs/shade/points_lights.h"
#include "runtime/scene/load/override_scene.h"

namespace kinora {

namespace {

// Floats are written with the digits that they need.
using OutputJson = nlohmann::basic_json<nlohmann::ordered_map, std::vector, std::string, bool,
                                        int64_t, uint64_t, float>;

// Parameters of type shader, and those of co-shaders that the shader cannot come to.
std::vector<std::string> decided_when_compiled(const PointsDocument& document,
                                               const rsl::Shader& shader) {
    std::vector<std::string> names;
    auto add = [&](const std::string& handle, std::string_view name) {
        names.push_back((handle.empty() ? "" : handle + ".") + std::string(name));
    };
    for (const rsl::Symbol* handle : shader.definition->handles) add("", handle->name);
    for (const rsl::LinkedPart& part : shader.parts)
        for (const std::string& name : part.handle_parameters) add(part.handle, name);
    for (const PointsShader& from : document.co_shaders)
        if (std::ranges::find(shader.definition->co_shaders, from.handle) ==
            shader.definition->co_shaders.end())
            for (const auto& [name, value] : from.parameters) add(from.handle, name);
    return names;
}

// Co-shaders of the file join those of the command line, their parameters as HANDLE.NAME. Texts
// decide which shaders are called.
ShadeOptions with_co_shaders(const ShadeOptions& options, PointsDocument& document,
                             ShadeSource& source) {
    ShadeOptions all = options;
    for (const PointsShader& from : document.co_shaders) {
        all.co_shaders.emplace_back(from.handle, from.file);
        for (const auto& [name, value] : from.parameters)
            document.parameters[from.handle + "." + name] = value;
    }
    for (const auto* values : {&document.variables, &document.parameters})
        for (const auto& [name, value] : *values)
            source.params.push_back({name, value.numbers, value.texts});
    return all;
}

PointsValues own_parameters(const ShadeOptions& options, const ShadeSource& source,
                            const PointsDocument& document, const rsl::Shader& shader) {
    PointsValues parameters;
    for (const ShadeParam& param : source.params)
        for (const rsl::ShaderParameter& parameter : shader.parameters)
            if (parameter.name == param.name)
                parameters[param.name] = {{}, param.numbers, param.strings, true};
    for (const auto& [name, value] : document.parameters) parameters[name] = value;
    for (const auto& [name, text] : options.params) {
        PointsValue value{{}, {}, {}, true};
        std::optional<std::vector<double>> numbers = parse_numbers(text);
        for (const rsl::ShaderParameter& parameter : shader.parameters)
            if (parameter.name == name && parameter.type.base == rsl::BaseType::String)
                numbers.reset();
        if (numbers && numbers->size() != 1) value.numbers = *numbers;
        if (numbers && numbers->size() == 1) value = {{}, *numbers, {}, false};
        if (!numbers) value.texts = {text};
        for (const rsl::ShaderParameter& parameter : shader.parameters)
            if (!numbers && parameter.name == name && parameter.type.is_array())
                value.texts = split_texts(text);
        if (!numbers) value.flat = true;
        parameters[name] = value;
    }
    for (const std::string& name : decided_when_compiled(document, shader)) parameters.erase(name);
    return parameters;
}

// One run of a stack, and what it leaves.
struct Pass {
    PointsStack stack;
    PointsKernel kernel;
    std::vector<const rsl::ShaderParameter*> outputs;
};

void want_outputs(const rsl::Shader& shader, Pass& pass) {
    pass.stack.lower.want_P = pass.stack.lower.want_N = true;
    pass.stack.lower.moves_points = true;
    for (const rsl::ShaderParameter& parameter : shader.parameters)
        if (parameter.output) {
            pass.outputs.push_back(&parameter);
            pass.stack.lower.aovs.push_back(std::string(parameter.name));
        }
}

// Components of something at a point; lists where there are several.
OutputJson number_json(const PointsKernel& kernel, const std::vector<rsl::KernelKey>& keys,
                       bool text, size_t point) {
    OutputJson list = OutputJson::array();
    for (const rsl::KernelKey& key : keys) {
        std::span<const float> row = kernel.output(key);
        float x = row.empty() ? 0.0f : row[point];
        if (text)
            list.push_back(rsl::interned(jit::bits_of(x)));
        else
            list.push_back(std::isfinite(x) ? OutputJson(x) : OutputJson(nullptr));
    }
    return list.size() == 1 ? list[0] : list;
}

OutputJson global_json(const PointsKernel& kernel, const PointSet& points, rsl::Global id) {
    OutputJson all = OutputJson::array();
    std::vector<rsl::KernelKey> keys;
    for (int c = 0; c < 3; ++c) keys.push_back(rsl::global_key(id, c));
    bool left = !kernel.output(keys[0]).empty();
    for (size_t i = 0; i < points.count(); ++i)
        all.push_back(
            left ? number_json(kernel, keys, false, i)
                 : OutputJson{points.row(id, 0)[i], points.row(id, 1)[i], points.row(id, 2)[i]});
    return all;
}

OutputJson output_json(const Pass& pass, const rsl::ShaderParameter& parameter, size_t count) {
    OutputJson all = OutputJson::array();
    rsl::BaseType base = parameter.type.base;
    bool text = base == rsl::BaseType::String;
    int elements = parameter.type.is_array() ? std::max(parameter.type.array_length, 1) : 1;
    for (size_t i = 0; i < count; ++i) {
        OutputJson value = OutputJson::array();
        for (int e = 0; e < elements; ++e) {
            std::vector<rsl::KernelKey> keys;
            for (int c = 0; c < rsl::component_count(base); ++c)
                keys.push_back(rsl::aov_key(parameter.name, parameter.type.is_array() ? e : -1,
                                            rsl::form_of(base), c));
            value.push_back(number_json(pass.kernel, keys, text, i));
        }
        all.push_back(parameter.type.is_array() ? value : value[0]);
    }
    return all;
}

// A light's L, from it to the point, and Cl; of a light of several statements the first that
// shines.
OutputJson light_json(const Pass& pass, const PointSet& points, rsl::LightColumn column) {
    OutputJson all = OutputJson::array();
    for (size_t i = 0; i < points.count(); ++i) {
        size_t shining = 0, statements = pass.kernel.lowered().light_statements.size();
        for (size_t s = statements; s-- > 0;) {
            std::span<const float> lit = pass.kernel.output(rsl::light_key(s, rsl::kLightLit, 0));
            if (lit.empty() || jit::bits_of(lit[i]) != 0) shining = s;
        }
        std::vector<rsl::KernelKey> keys;
        for (int c = 0; c < 3; ++c) keys.push_back(rsl::light_key(shining, column, c));
        OutputJson value = number_json(pass.kernel, keys, false, i);
        if (column == rsl::kLightL)
            for (OutputJson& x : value)
                if (x.is_number()) x = 0.0f - x.get<float>();
        all.push_back(value);
    }
    return all;
}

// What the displacement leaves is where the surface is.
void displace(PointSet& points, const Pass& pass) {
    for (rsl::Global id : {rsl::Global::P, rsl::Global::N}) {
        std::vector<float> components[3];
        for (int c = 0; c < 3; ++c) {
            std::span<const float> row = pass.kernel.output(rsl::global_key(id, c));
            components[c].assign(row.begin(), row.end());
        }
        points.set(id, components);
    }
}

// The whole run, from the document to what is printed.
class PointsRun {
  public:
    PointsRun(const ShadeOptions& options, PointsDocument document)
        : document_(std::move(document)),
          options_(with_co_shaders(options, document_, source_)),
          points_(document_),
          textures_(options.compile.pictures) {}

    int run() {
        if (std::optional<int> code = compile_shade_source(options_, source_)) return *code;
        const rsl::Shader* shader = choose_shader(options_, source_);
        if (!shader || !can_run(*shader)) return kExitUsage;
        const PointsDocument& document = points_.document();
        if (document.displacement)
            if (std::optional<int> code = run_displacement(*shader)) return *code;
        if (std::optional<int> code = lights_.open(options_, points_)) return *code;
        uint32_t index = uint32_t(main_.stack.layers.size());
        main_.stack.current_from_shader = points_.current_from_space("shader");
        main_.stack.layers.push_back(
            bind_points_layer(*shader, index, own_parameters(options_, source_, document, *shader),
                              main_.stack.current_from_shader, document, main_.stack.numbers));
        main_.stack.lower.math = options_.math;
        if (shader->kind != rsl::ShaderKind::Light) want_outputs(*shader, main_);
        if (!main_.kernel.compile(main_.stack, options_.target, source_.diagnostics)) {
            source_.print_findings(options_);
            return kExitShader;
        }
        if (!lights_.bind(options_, main_.kernel.lowered())) return kExitShader;
        main_.kernel.run(points_, main_.stack, textures_, &lights_);
        main_.kernel.report(source_.diagnostics);
        textures_.report(source_.diagnostics);
        source_.print_findings(options_);
        lights_.report(options_);
        tell_unused(*shader);
        print(*shader);
        return source_.exit_code(options_, kExitOk);
    }

  private:
    std::optional<int> run_displacement(const rsl::Shader& above) {
        const PointsShader& from = *points_.document().displacement;
        if (above.kind != rsl::ShaderKind::Surface)
            throw PointsError("displacement: stands before a surface alone");
        ShadeOptions own = options_;
        own.source = from.file;
        own.shader = from.shader;
        for (const auto& [name, value] : from.parameters)
            before_source_.params.push_back({name, value.numbers, value.texts});
        if (std::optional<int> code = compile_shade_source(own, before_source_)) return code;
        const rsl::Shader* shader = choose_shader(own, before_source_);
        if (!shader) return kExitUsage;
        if (shader->kind != rsl::ShaderKind::Displacement)
            throw PointsError(fmt::format("displacement: '{}' is a {} shader", shader->name,
                                          rsl::shader_kind_name(shader->kind)));
        Pass& pass = before_.emplace_back();
        pass.stack.current_from_shader = from.current_from_shader;
        pass.stack.layers = {bind_points_layer(*shader, 0, from.parameters,
                                               from.current_from_shader, points_.document(),
                                               pass.stack.numbers)};
        pass.stack.lower.math = options_.math;
        want_outputs(*shader, pass);
        if (!pass.kernel.compile(pass.stack, options_.target, before_source_.diagnostics)) {
            before_source_.print_findings(options_);
            return kExitShader;
        }
        pass.kernel.run(points_, pass.stack, textures_, nullptr);
        pass.kernel.report(before_source_.diagnostics);
        before_source_.print_findings(options_);
        displace(points_, pass);
        return std::nullopt;
    }

    // Variables that nobody reads are most likely misspelt.
    void tell_unused(const rsl::Shader& shader) {
        std::vector<std::string_view> names;
        bool any = false;  // a name that is known at run time alone
        for (const rsl::GlobalInfo& global : rsl::globals()) names.push_back(global.name);
        auto add = [&](const rsl::Shader& one) {
            for (const rsl::ShaderParameter& parameter : one.parameters)
                names.push_back(parameter.name);
            for (const rsl::VertexRequest& request : one.vertex_requests) {
                names.push_back(request.name);
                any = any || request.name.empty();
            }
        };
        add(shader);
        for (const Pass& pass : before_) add(*pass.stack.layers[0].shader);
        for (const auto& [name, value] : points_.document().variables) {
            if (std::find(names.begin(), names.end(), name) != names.end()) continue;
            if (!value.lengths.empty() && value.lengths[0] != points_.count() &&
                value.size() != 3 && value.size() != 16)
                throw PointsError(fmt::format("{}: {} for {} points", name,
                                              points_shape(value.lengths, value.is_text()),
                                              points_.count()));
            if (any) continue;
            std::string_view near = nearest_name(name, names);
            if (!options_.quiet)
                std::fprintf(stderr, "kinora-shade: no shader reads the variable '%s'%s\n",
                             name.c_str(),
                             near.empty() ? "" : fmt::format("; did you mean '{}'?", near).c_str());
        }
    }

    void print(const rsl::Shader& shader) {
        std::vector<std::pair<std::string, OutputJson>> rows;
        auto add = [&](const char* name, rsl::Global id) {
            rows.emplace_back(name, global_json(main_.kernel, points_, id));
        };
        if (shader.kind == rsl::ShaderKind::Light) {
            rows.emplace_back("L", light_json(main_, points_, rsl::kLightL));
            rows.emplace_back("Cl", light_json(main_, points_, rsl::kLightCl));
        } else {
            if (shader.kind == rsl::ShaderKind::Surface) {
                add("Ci", rsl::Global::Ci);
                add("Oi", rsl::Global::Oi);
            }
            add("P", rsl::Global::P);
            add("N", rsl::Global::N);
        }
        auto add_outputs = [&](const Pass& pass) {
            for (const rsl::ShaderParameter* parameter : pass.outputs)
                rows.emplace_back(std::string(parameter->name),
                                  output_json(pass, *parameter, points_.count()));
        };
        for (const Pass& pass : before_) add_outputs(pass);
        add_outputs(main_);
        std::string text = fmt::format("{{\n\"points\": {}", points_.count());
        for (const auto& [name, values] : rows)
            text += fmt::format(",\n{}: {}", OutputJson(name).dump(),
                                values.dump(-1, ' ', false, OutputJson::error_handler_t::replace));
        std::puts((text + "\n}").c_str());
    }

    ShadeSource source_, before_source_;
    PointsDocument document_;
    const ShadeOptions options_;
    PointSet points_;
    TextureStore textures_;
    std::vector<Pass> before_;  // a displacement
    PointsLights lights_;
    Pass main_;
};

}  // namespace

int shade_points(const ShadeOptions& options) {
    try {
        PointsDocument document = read_points_document(options.points);
        return PointsRun(options, document).run();
    } catch (const PointsError& error) {
        std::fprintf(stderr, "kinora-shade: %s: %s\n", options.points.c_str(), error.what());
        return kExitUsage;
    }
}

}  // namespace kinora
