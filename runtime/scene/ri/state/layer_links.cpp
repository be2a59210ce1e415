// runtime/scene/ri/state/layer_links.cpp: ConnectShaderLayers.
#include "runtime/scene/ri/state/layer_links.h"

#include <fmt/format.h>

#include <algorithm>

namespace kinora::ri {
namespace {

// The topmost layer of that name.
size_t find_layer(const std::vector<Binding>& layers, std::string_view name) {
    for (size_t k = layers.size(); k-- > 0;)
        if (layers[k]->layer == name) return k;
    return layers.size();
}

const rsl::ShaderParameter* find_variable(const rsl::Shader& shader, std::string_view name) {
    for (const rsl::ShaderParameter& parameter : shader.parameters)
        if (parameter.name == name) return &parameter;
    return nullptr;
}

// Of a parameter, or of Cs and Os, which colour what is below them by themselves.
std::optional<rsl::Type> input_type(const rsl::Shader& shader, std::string_view name) {
    if (const rsl::ShaderParameter* parameter = find_variable(shader, name)) return parameter->type;
    if (name == "Cs" || name == "Os") return rsl::Type{rsl::BaseType::Color, -1};
    return std::nullopt;
}

// Whether a value of the one is one of the other: floats and triples become each other.
bool fits(const rsl::Type& from, const rsl::Type& to) {
    if (from.array_length != to.array_length) return false;
    bool number = from.base == rsl::BaseType::Float || rsl::is_triple(from.base);
    bool wanted = to.base == rsl::BaseType::Float ? from.base == to.base : rsl::is_triple(to.base);
    return from.base == to.base || (number && wanted);
}

std::string unknown(std::string_view kind, std::string_view name) {
    return fmt::format("there is no {} '{}'", kind, name);
}

}  // namespace

std::string connect(std::vector<Binding>& layers, LayerVariable from, LayerVariable to) {
    const size_t below = find_layer(layers, from.layer), above = find_layer(layers, to.layer);
    if (below == layers.size()) return unknown("layer", from.layer);
    if (above == layers.size()) return unknown("layer", to.layer);
    if (below >= above)
        return fmt::format("layer '{}' does not come before '{}'", from.layer, to.layer);
    const rsl::ShaderParameter* output = find_variable(*layers[below]->shader, from.name);
    std::optional<rsl::Type> input = input_type(*layers[above]->shader, to.name);
    if (!output) return unknown("parameter", from.name);
    if (!input) return unknown("parameter", to.name);
    if (!fits(output->type, *input))
        return fmt::format("'{}' and '{}' are of different types", from.name, to.name);
    ShaderBinding linked = *layers[above];
    std::erase_if(linked.links, [&](const LayerLink& link) { return link.param == to.name; });
    linked.links.push_back({std::string(to.name), uint32_t(above - below), std::string(from.name)});
    layers[above] = std::make_shared<const ShaderBinding>(std::move(linked));
    return "";
}

}  // namespace kinora::ri
