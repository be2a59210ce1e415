// runtime/programs/shade/bind.cpp: parameter values from text, the outputs wanted.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdio>

#include "runtime/programs/common/exit_codes.h"
#include "runtime/programs/shade/co_shaders.h"
#include "runtime/programs/shade/kernel.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/load/override_scene.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

namespace {

using rsl::BaseType;

int usage(const std::string& text) {
    std::fprintf(stderr, "kinora-shade: %s\n", text.c_str());
    return kExitUsage;
}

size_t elements(const rsl::Type& type) {
    return type.is_array() ? size_t(std::max(type.array_length, 1)) : 1;
}
size_t width_of(const rsl::Type& type) {
    return size_t(rsl::component_count(type.base));
}

const rsl::ShaderParameter* find_parameter(const rsl::Shader& shader, const std::string& name) {
    for (const rsl::ShaderParameter& parameter : shader.parameters)
        if (parameter.name == name) return &parameter;
    return nullptr;
}

int unknown_parameter(const rsl::Shader& shader, const std::string& name) {
    std::vector<std::string_view> names;
    std::string all;
    for (const rsl::ShaderParameter& parameter : shader.parameters) {
        names.push_back(parameter.name);
        all += fmt::format(" {}", parameter.name);
    }
    std::string_view near = nearest_name(name, names);
    return usage(fmt::format("shader '{}' has no parameter '{}'{}", shader.name, name,
                             !near.empty() ? fmt::format("; did you mean '{}'?", near)
                             : all.empty() ? "; it has none"
                                           : "; it has" + all));
}

// A --param as numbers or strings that fit the parameter; one number spreads over a triple.
int parse_param(const rsl::ShaderParameter& parameter, const std::string& text, ShadeParam& out) {
    out.name = std::string(parameter.name);
    if (parameter.type.base == BaseType::String) {
        out.strings = parameter.type.is_array() ? split_texts(text) : std::vector{text};
        if (out.strings.size() == elements(parameter.type)) return kExitOk;
        return usage(fmt::format("--param {}: a {} takes {} texts, not {}; commas divide them",
                                 out.name, rsl::type_name(parameter.type), elements(parameter.type),
                                 out.strings.size()));
    }
    std::optional<std::vector<double>> numbers = parse_numbers(text);
    if (!numbers)
        return usage(fmt::format("--param {}: '{}' is no {}", out.name, text,
                                 rsl::type_name(parameter.type)));
    out.numbers = *numbers;
    size_t needed = elements(parameter.type) * width_of(parameter.type);
    if (out.numbers.size() == 1 && rsl::is_triple(parameter.type))
        out.numbers.resize(3, out.numbers[0]);
    if (out.numbers.size() != needed)
        return usage(fmt::format("--param {}: a {} takes {} number{}, not {}", out.name,
                                 rsl::type_name(parameter.type), needed, needed == 1 ? "" : "s",
                                 out.numbers.size()));
    return kExitOk;
}

void bind_value(const rsl::ShaderParameter& parameter, bool shape, size_t layer,
                const ShadeParam& param, const Patch& patch, ShadeStack& stack) {
    rsl::ParamBinding binding;
    binding.name = param.name;
    BaseType base = parameter.type.base;
    size_t width = width_of(parameter.type), count = elements(parameter.type);
    if (base == BaseType::String) {
        binding.kind = rsl::ParamBinding::Kind::Constant;
        binding.strings = param.strings;
    } else {
        std::vector<double> numbers = param.numbers;
        numbers.resize(count * width, numbers.empty() ? 0.0 : numbers.back());
        for (size_t e = 0; e < count && rsl::is_spatial(base); ++e) {
            dvec3 moved =
                parameter_in_current(base, patch.current_from_space("shader"), &numbers[e * width]);
            std::copy_n(&moved[0], 3, &numbers[e * width]);
        }
        binding.kind = shape ? rsl::ParamBinding::Kind::Constant : rsl::ParamBinding::Kind::Frame;
        for (size_t e = 0; e < count; ++e)
            for (size_t c = 0; c < width; ++c) {
                float value = float(numbers[e * width + c]);
                int element = parameter.type.is_array() ? int(e) : -1;
                stack.values[rsl::parameter_key(uint32_t(layer), param.name, element,
                                                rsl::form_of(base), int(c))] = value;
                if (shape) binding.constant.push_back(value);
            }
    }
    stack.layers[layer].params.push_back(std::move(binding));
}

}  // namespace

std::pair<std::string, int> output_element(const std::string& output) {
    size_t dot = output.rfind('.');
    if (dot == output.npos) return {output, -1};
    int element = -1;
    const char* end = output.data() + output.size();
    auto [rest, error] = std::from_chars(output.data() + dot + 1, end, element);
    bool number = error == std::errc() && rest == end && element >= 0;
    return number ? std::pair(output.substr(0, dot), element) : std::pair(output, -1);
}

namespace {

int choose_outputs(const std::string& output, const rsl::Shader& shader, ShadeStack& stack) {
    if (output == "Ci" || output == "Oi") return kExitOk;
    if (output == "N" || output == "P") {
        (output == "N" ? stack.lower.want_N : stack.lower.want_P) = true;
        return kExitOk;
    }
    std::vector<std::string_view> names = {"Ci", "Oi", "N", "P"};
    std::string all = "Ci, Oi, N, P";
    auto [name, element] = output_element(output);
    for (const rsl::ShaderParameter& parameter : shader.parameters) {
        if (!parameter.output) continue;
        bool array = parameter.type.is_array();
        if (parameter.name == name && array == (element >= 0) &&
            element < std::max(parameter.type.array_length, 1)) {
            stack.lower.aovs.push_back(name);
            return kExitOk;
        }
        if (!array) names.push_back(parameter.name);
        std::string last = fmt::format("{}.{}", parameter.name, parameter.type.array_length - 1);
        all += array ? fmt::format(", {}.0 to {}", parameter.name, last)
                     : fmt::format(", {}", parameter.name);
    }
    if (rsl::named_output(shader, output)) {
        stack.lower.aovs.push_back(output);
        return kExitOk;
    }
    std::string_view near = nearest_name(output, names);
    return usage(
        fmt::format("'{}' is no output of shader '{}'; {}", output, shader.name,
                    near.empty() ? "outputs are " + all : fmt::format("did you mean '{}'?", near)));
}

}  // namespace

int bind_stack(const ShadeOptions& options, const ShadeSource& source, const rsl::Shader& shader,
               const Patch& patch, ShadeStack& stack) {
    stack.light = shader.kind == rsl::ShaderKind::Light;
    stack.lower.math = options.math;
    stack.lower.skip_transparent = true;
    stack.layers.push_back({&shader, {}});
    std::vector<ShadeParam> params;
    for (const ShadeParam& param : source.params)
        if (find_parameter(shader, param.name)) params.push_back(param);
    for (const auto& [name, text] : options.params) {
        auto handles = shader.definition->handles;
        if (std::any_of(handles.begin(), handles.end(),
                        [&](const rsl::Symbol* handle) { return handle->name == name; }))
            continue;  // compiled in
        const rsl::ShaderParameter* parameter = find_parameter(shader, name);
        if (!parameter) return unknown_parameter(shader, name);
        std::erase_if(params, [&](const ShadeParam& p) { return p.name == name; });
        if (int code = parse_param(*parameter, text, params.emplace_back())) return code;
    }
    std::vector<bool> shape = rsl::shape_parameters(shader);
    for (const ShadeParam& param : params) {
        const rsl::ShaderParameter* parameter = find_parameter(shader, param.name);
        bind_value(*parameter, shape[size_t(parameter - shader.parameters.data())], 0, param, patch,
                   stack);
    }
    if (shader.kind == rsl::ShaderKind::Displacement) {
        stack.library.push_back(library_shader("matte"));
        stack.layers.push_back({stack.library.back().get(), {}});
    }
    if (stack.light) {
        if (options.output == "Ci") return kExitOk;
        return usage("a light's picture is what it gives a white surface; it has no --output " +
                     options.output);
    }
    return choose_outputs(options.output, shader, stack);
}

std::optional<int> open_stack(const ShadeOptions& options, ShadeSource& source, Patch& patch,
                              ShadeStack& stack) {
    if (std::optional<int> code = compile_shade_source(options, source)) return code;
    const rsl::Shader* shader = choose_shader(options, source);
    if (!shader || !can_run(*shader)) return kExitUsage;
    if (!options.target && jit::best_target().name == std::string_view("interp"))
        source.diagnostics.report(Code::TARGET_INTERPRETED, Location{});
    source.print_findings(options);
    patch.textures = std::make_shared<TextureStore>(options.compile.pictures);
    if (shader->kind == rsl::ShaderKind::Light) patch.set_light(options.flip);
    if (int code = bind_stack(options, source, *shader, patch, stack)) return code;
    return std::nullopt;
}

}  // namespace kinora
