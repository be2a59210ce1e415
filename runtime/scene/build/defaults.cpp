// runtime/scene/build/defaults.cpp: the default lights and the grey world.
#include "runtime/scene/build/defaults.h"

#include "runtime/scene/description/shader_library.h"

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
    node.id = node.name = kDefaultLightNode;
    // Turned left and up from the camera, so that it shines along -z over its left shoulder.
    node.transforms.push_back({TransformKind::Rotate, append(values, {0, 1, 0, -35})});
    node.transforms.push_back({TransformKind::Rotate, append(values, {1, 0, 0, -35})});
    return node;
}

std::vector<LightDefinition> default_lights(std::vector<double>& values) {
    // Judged on white spheres: the key's middle is just not burnt, the darkest tenth a fifth of it.
    struct Row {
        const char *name, *shader;
        double strength;
        bool shadows;
    };
    static constexpr Row kRows[] = {{kKeyLight, "collada_directional", 0.85, true},
                                    {kFillLight, "default_fill", 0.22, false},
                                    {kRimLight, "default_rim", 0.35, false},
                                    {kGreyWorld, kGreyWorldShader, kGreyWorldLight, false}};
    std::vector<LightDefinition> lights;
    for (const Row& row : kRows) {
        LightDefinition& light = lights.emplace_back();
        light.id = light.name = row.name;
        light.shader.shader = library_shader(row.shader);
        if (!row.shadows) light.shadows = false;
        ParamSource color;
        color.name = "lightcolor";
        color.value = {append(values, {row.strength, row.strength, row.strength}), 3};
        light.shader.params.push_back(color);
    }
    return lights;
}

}  // namespace kinora
