// runtime/build/defaults.cpp: the default lights.
#include "runtime/build/defaults.h"

#include "runtime/description/shader_library.h"

namespace kinora {

namespace {

uint32_t append(std::vector<double>& values, std::initializer_list<double> numbers) {
    uint32_t offset = uint32_t(values.size());
    values.insert(values.end(), numbers);
    values.resize(offset + 16, 0.0);
    return offset;
}

}  // namespace

NodeDefinition default_light_node(std::vector<double>& values) {
    NodeDefinition node;
    node.id = node.name = "default light";
    // Turned left and up from the camera, so that it shines along -z over its left shoulder.
    node.transforms.push_back({TransformKind::Rotate, append(values, {0, 1, 0, -35})});
    node.transforms.push_back({TransformKind::Rotate, append(values, {1, 0, 0, -35})});
    return node;
}

LightDefinition default_distant_light(Diagnostics& diagnostics) {
    LightDefinition light;
    light.id = light.name = "default light";
    light.shader.shader = library_shader("collada_directional", diagnostics);
    return light;
}

LightDefinition default_ambient_light(std::vector<double>& values, Diagnostics& diagnostics) {
    LightDefinition light;
    light.id = light.name = "default ambient light";
    light.ambient = true;
    light.shader.shader = library_shader("collada_ambient", diagnostics);
    ParamSource color;
    color.name = "lightcolor";
    color.value = {append(values, {0.15, 0.15, 0.15}), 3};
    light.shader.params.push_back(color);
    return light;
}

}  // namespace kinora
