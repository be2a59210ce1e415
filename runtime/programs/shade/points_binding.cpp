// runtime/programs/shade/points_binding.cpp: values to parameters, by their shapes.
#include "runtime/programs/shade/points_binding.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/shaders/shader_instance.h"

namespace kinora {

namespace {

using rsl::BaseType;

// The lists of one value of the type.
std::vector<size_t> shape_of(rsl::Type type) {
    std::vector<size_t> shape;
    if (type.is_array()) shape.push_back(size_t(std::max(type.array_length, 1)));
    if (size_t width = size_t(rsl::component_count(type.base)); width > 1) shape.push_back(width);
    return shape;
}

size_t product(const std::vector<size_t>& shape) {
    size_t all = 1;
    for (size_t length : shape) all *= length;
    return all;
}

const rsl::ShaderParameter* parameter_named(const rsl::Shader& shader, std::string_view name) {
    for (const rsl::ShaderParameter& parameter : shader.parameters)
        if (parameter.name == name) return &parameter;
    return nullptr;
}

void check_names(const rsl::Shader& shader, const PointsValues& parameters) {
    std::vector<std::string_view> names;
    for (const rsl::ShaderParameter& parameter : shader.parameters) names.push_back(parameter.name);
    for (const auto& [name, value] : parameters) {
        if (parameter_named(shader, name)) continue;
        std::string_view near = nearest_name(name, names);
        throw PointsError(
            fmt::format("shader '{}' has no parameter '{}'{}", shader.name, name,
                        near.empty() ? std::string() : fmt::format("; did you mean '{}'?", near)));
    }
}

void move_to_current(BaseType base, const dmat4& current_from_shader,
                     std::vector<double>& numbers) {
    for (size_t i = 0; i + 3 <= numbers.size(); i += 3) {
        dvec3 moved = parameter_in_current(base, current_from_shader, &numbers[i]);
        std::copy_n(&moved[0], 3, &numbers[i]);
    }
}

rsl::ParamBinding binding_of(const rsl::ShaderParameter& parameter, bool shape, uint32_t layer,
                             FittedValue fitted, PointsNumbers& numbers) {
    rsl::ParamBinding binding;
    binding.name = parameter.name;
    BaseType base = parameter.type.base;
    if (base == BaseType::String) {
        binding.kind = rsl::ParamBinding::Kind::Constant;
        binding.strings = fitted.value.texts;
    } else if (fitted.per_point) {
        binding.kind = rsl::ParamBinding::Kind::Varying;
        binding.plain = true;
        numbers.varying[{layer, rsl::name_id(parameter.name)}] = std::move(fitted);
    } else {
        binding.kind = shape ? rsl::ParamBinding::Kind::Constant : rsl::ParamBinding::Kind::Frame;
        int width = rsl::component_count(base);
        const std::vector<double>& values = fitted.value.numbers;
        for (size_t k = 0; k < values.size(); ++k) {
            int element = parameter.type.is_array() ? int(k) / width : -1;
            numbers.uniform[rsl::parameter_key(layer, parameter.name, element, rsl::form_of(base),
                                               int(k) % width)] = float(values[k]);
            if (shape) binding.constant.push_back(float(values[k]));
        }
    }
    return binding;
}

std::optional<FittedValue> try_fit(const PointsValue& value, rsl::Type type, size_t count) {
    std::vector<size_t> one = shape_of(type), each = one;
    each.insert(each.begin(), count);
    FittedValue fitted{false, value};
    bool text = type.base == BaseType::String;
    if (text != value.is_text()) return {};
    if (value.flat ? value.size() == product(one) : value.lengths == one) return fitted;
    if (value.lengths == each && !text) {
        fitted.per_point = true;
        return fitted;
    }
    if (value.size() != 1 || !value.lengths.empty() || !rsl::is_triple(type)) return {};
    fitted.value.numbers.resize(3, value.numbers[0]);
    return fitted;
}

// Variables that the shader reads and no parameter declares, where their values fit.
void bind_requests(const rsl::Shader& shader, uint32_t layer, const PointsDocument& document,
                   rsl::Layer& out, PointsNumbers& numbers) {
    for (const rsl::VertexRequest& request : shader.vertex_requests)
        for (const auto& [name, value] : document.variables) {
            rsl::ShaderParameter parameter;
            std::string binding = rsl::vertex_request_name(request.type, name);
            parameter.name = binding;
            parameter.type = {request.type, -1};
            bool meant = request.name.empty() || request.name == name;
            if (!meant || request.type == BaseType::String) continue;
            std::optional<FittedValue> fitted = try_fit(value, parameter.type, document.count);
            if (fitted)
                out.params.push_back(
                    binding_of(parameter, false, layer, *std::move(fitted), numbers));
        }
}

// Cs and Os, which are 1 where nobody says otherwise.
void bind_color(const char* name, uint32_t layer, const PointsDocument& document, rsl::Layer& out,
                PointsNumbers& numbers) {
    auto found = document.variables.find(name);
    if (found == document.variables.end()) return;
    FittedValue fitted = fit_value(name, found->second, {BaseType::Color, -1}, document.count);
    rsl::ParamBinding binding;
    binding.name = name;
    binding.kind = rsl::ParamBinding::Kind::Varying;
    binding.plain = true;
    numbers.varying[{layer, rsl::name_id(name)}] = std::move(fitted);
    out.params.push_back(std::move(binding));
}

}  // namespace

FittedValue fit_value(const std::string& where, const PointsValue& value, rsl::Type type,
                      size_t count) {
    if (std::optional<FittedValue> fitted = try_fit(value, type, count)) return *std::move(fitted);
    std::vector<size_t> one = shape_of(type), each = one;
    each.insert(each.begin(), count);
    bool text = type.base == BaseType::String;
    std::string got = value.flat ? fmt::format("{} of them", value.size())
                                 : points_shape(value.lengths, value.is_text());
    std::string wanted = points_shape(one, text);
    if (!text && !value.flat) wanted += ", or one a point: " + points_shape(each, text);
    throw PointsError(
        fmt::format("{}: a {} takes {}; this is {}", where, rsl::type_name(type), wanted, got));
}

rsl::Layer bind_points_layer(const rsl::Shader& shader, uint32_t index,
                             const PointsValues& parameters, const dmat4& current_from_shader,
                             const PointsDocument& document, PointsNumbers& numbers) {
    check_names(shader, parameters);
    rsl::Layer layer{&shader, {}};
    std::vector<bool> shape = rsl::shape_parameters(shader);
    for (size_t p = 0; p < shader.parameters.size(); ++p) {
        const rsl::ShaderParameter& parameter = shader.parameters[p];
        std::string name(parameter.name);
        auto variable = document.variables.find(name);
        if (size_t dot = name.rfind('.'); variable == document.variables.end() && dot < name.size())
            variable = document.variables.find(name.substr(dot + 1));  // of a co-shader
        bool is_variable = variable != document.variables.end();
        auto own = parameters.find(name);
        if (!is_variable && own == parameters.end()) continue;
        FittedValue fitted = fit_value(name, is_variable ? variable->second : own->second,
                                       parameter.type, is_variable ? document.count : 1);
        if (fitted.per_point && parameter.detail != rsl::Detail::Varying)
            throw PointsError(fmt::format(
                "{}: shader '{}' has it as a uniform parameter, which takes one value; declare it "
                "'varying {}' for one a point",
                name, shader.name, rsl::type_name(parameter.type)));
        if (!is_variable && rsl::is_spatial(parameter.type.base))
            move_to_current(parameter.type.base, current_from_shader, fitted.value.numbers);
        layer.params.push_back(binding_of(parameter, shape[p], index, std::move(fitted), numbers));
    }
    bind_requests(shader, index, document, layer, numbers);
    for (const char* name : {"Cs", "Os"}) bind_color(name, index, document, layer, numbers);
    return layer;
}

}  // namespace kinora
