// runtime/build/defaults.cpp: the default camera and lights.
#include "runtime/build/defaults.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "runtime/description/shader_library.h"

namespace kinora {

namespace {

constexpr double kDefaultYfov = 37.0;  // degrees
constexpr double kFrameMargin = 1.05;

// The up-axis frames of COLLADA 1.4.1 (chapter 5, up_axis): right, up and towards the viewer.
struct Frame {
    dvec3 right, up, back;
};
Frame frame_of(UpAxis up) {
    switch (up) {
        case UpAxis::X:
            return {dvec3(0, -1, 0), dvec3(1, 0, 0), dvec3(0, 0, 1)};
        case UpAxis::Y:
            return {dvec3(1, 0, 0), dvec3(0, 1, 0), dvec3(0, 0, 1)};
        case UpAxis::Z:
            break;
    }
    return {dvec3(1, 0, 0), dvec3(0, 0, 1), dvec3(0, -1, 0)};
}

uint32_t append(std::vector<double>& values, std::initializer_list<double> numbers) {
    uint32_t offset = uint32_t(values.size());
    values.insert(values.end(), numbers);
    values.resize(offset + 16, 0.0);
    return offset;
}

}  // namespace

DefaultCamera default_camera(const Bounds& bounds, UpAxis up, std::vector<double>& values) {
    Frame frame = frame_of(up);
    dvec3 direction = glm::normalize(frame.right + 0.6 * frame.up + frame.back);
    dvec3 centre = 0.5 * (bounds.low + bounds.high);
    double radius = std::max(0.5 * glm::length(bounds.high - bounds.low), 1e-12);
    double distance = kFrameMargin * radius / std::sin(0.5 * radians(kDefaultYfov));
    dvec3 eye = centre + distance * direction;
    DefaultCamera result;
    result.node.id = result.node.name = "default camera";
    result.node.transforms.push_back(
        {TransformKind::Lookat, append(values, {eye.x, eye.y, eye.z, centre.x, centre.y, centre.z,
                                                frame.up.x, frame.up.y, frame.up.z})});
    result.camera.id = result.camera.name = "default camera";
    result.camera.y = {append(values, {kDefaultYfov}), 1};
    result.camera.znear = {append(values, {distance * 1e-3}), 1};
    result.camera.zfar = {append(values, {distance + 4 * radius}), 1};
    return result;
}

NodeDefinition default_light_node(std::vector<double>& values) {
    NodeDefinition node;
    node.id = node.name = "default light";
    // Turned left and up from the camera, so that it shines along -z over its left shoulder.
    node.transforms.push_back({TransformKind::Rotate, append(values, {0, 1, 0, -35})});
    node.transforms.push_back({TransformKind::Rotate, append(values, {1, 0, 0, -35})});
    return node;
}

std::vector<LightDefinition> default_lights(std::vector<double>& values, Diagnostics& diagnostics) {
    // Judged on white spheres: the key's middle is just not burnt, the darkest tenth a fifth of it.
    struct Row {
        const char *name, *shader;
        double strength;
        bool shadows;
    };
    static constexpr Row kRows[] = {{"default key light", "collada_directional", 0.85, true},
                                    {"default fill light", "default_fill", 0.22, false},
                                    {"default rim light", "default_rim", 0.35, false}};
    std::vector<LightDefinition> lights;
    for (const Row& row : kRows) {
        LightDefinition& light = lights.emplace_back();
        light.id = light.name = row.name;
        light.shader.shader = library_shader(row.shader, diagnostics);
        if (!row.shadows) light.shadows = false;
        ParamSource color;
        color.name = "lightcolor";
        color.value = {append(values, {row.strength, row.strength, row.strength}), 3};
        light.shader.params.push_back(color);
    }
    return lights;
}

}  // namespace kinora
