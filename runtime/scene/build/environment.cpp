// runtime/scene/build/environment.cpp: the light of what lies around a scene: envlight.sl on a node
// of its own, whose turn is that of the picture.
#include "runtime/scene/build/environment.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "rsl/model/renderer_services.h"
#include "runtime/scene/description/default_lights.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/shader_library.h"
#include "runtime/scene/images/texture_store.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

// ---- the picture --------------------------------------------------------------------------------

constexpr float kBright = 1e20f;  // sums of such light may be no numbers

// Texels that give no light, or one that pictures can hardly hold.
struct OddTexels {
    size_t negative = 0, no_number = 0, bright = 0;
    size_t count() const { return negative + no_number + bright; }
};

OddTexels odd_texels(const TexturePyramid& pyramid) {
    OddTexels odd;
    const TextureLevel& level = pyramid.levels[0];
    for (int y = 0; y < level.height; ++y)
        for (int x = 0; x < level.width; ++x) {
            const auto texel = pyramid.texel(0, x, y);
            bool number = true, negative = false, bright = false;
            for (int k = 0; k < 3; ++k) {
                number &= std::isfinite(texel[k]);
                negative |= texel[k] < 0;
                bright |= texel[k] > kBright;
            }
            odd.no_number += !number;
            odd.negative += number && negative;
            odd.bright += number && bright;
        }
    return odd;
}

// False after an error.
bool look_at_picture(Scene& scene, const EnvironmentDefinition& environment,
                     Diagnostics& diagnostics) {
    if (environment.picture.empty()) return true;
    const Texture* texture = scene.textures->find(rsl::intern(environment.picture));
    const StoredImage& image = *texture->image;
    if (!image.error.empty()) {
        diagnostics.report(Code::ENVIRONMENT_UNREADABLE, environment.where, image.path,
                           image.error);
        return false;
    }
    OddTexels odd = image.faces.empty() ? odd_texels(image.pyramid) : OddTexels{};
    for (const TexturePyramid& face : image.faces) {
        const OddTexels of_face = odd_texels(face);
        odd.negative += of_face.negative;
        odd.no_number += of_face.no_number;
        odd.bright += of_face.bright;
    }
    if (odd.count() > 0)
        diagnostics.report(Code::ENVIRONMENT_VALUES, environment.where, image.path, odd.no_number,
                           odd.negative, odd.bright, kBright);
    return true;
}

// ---- its place ----------------------------------------------------------------------------------

// Up, and where the middle of a picture lies: to the right of the axis' view, as +x is in Blender.
struct Axes {
    dvec3 up, middle;
};
constexpr Axes kAxes[] = {{{1, 0, 0}, {0, -1, 0}}, {{0, 1, 0}, {1, 0, 0}}, {{0, 0, 1}, {1, 0, 0}}};

// The node's y is up, and it looks, as lights do along -z, to the picture's middle.
NodeDefinition node_of(SceneDescription& description, const EnvironmentDefinition& environment) {
    const Axes& axes = kAxes[size_t(description.up_axis)];
    const dmat3 from_world(description.world_space);
    const dvec3 up = glm::normalize(from_world * axes.up);
    dvec3 middle = from_world * axes.middle;
    middle = glm::normalize(middle - glm::dot(middle, up) * up);
    const double turn = radians(environment.rotation);
    middle = std::cos(turn) * middle + std::sin(turn) * glm::cross(up, middle);
    const dvec3 right = glm::cross(middle, up);
    NodeDefinition node;
    node.id = node.name = kEnvironment;
    const auto offset = uint32_t(description.values.size());
    for (int row = 0; row < 3; ++row)
        for (double x : {right[row], up[row], -middle[row], 0.0}) description.values.push_back(x);
    for (double x : {0.0, 0.0, 0.0, 1.0}) description.values.push_back(x);
    node.transforms.push_back({TransformKind::Matrix, offset});
    return node;
}

// ---- its light ----------------------------------------------------------------------------------

ParamSource numbers(SceneDescription& description, const char* name,
                    std::initializer_list<double> values) {
    ParamSource source;
    source.name = name;
    source.value = {uint32_t(description.values.size()), uint32_t(values.size())};
    description.values.insert(description.values.end(), values);
    return source;
}

LightDefinition light_of(Scene& scene, const EnvironmentDefinition& environment) {
    SceneDescription& description = *scene.description;
    LightDefinition light;
    light.id = light.name = kEnvironment;
    light.where = environment.where;
    light.surrounds = true;
    light.behind_picture = environment.behind_picture;
    ShaderUse& use = light.shader;
    use.shader = environment.shader ? environment.shader : library_shader("envlight");
    auto add = [&](ParamSource source) {
        const auto& known = use.shader->parameters;
        if (std::ranges::any_of(known, [&](const auto& p) { return p.name == source.name; }))
            use.params.push_back(std::move(source));
    };
    const dvec3& color = environment.color;
    if (!environment.shader) {
        ParamSource map;
        map.name = "map";
        map.strings = {environment.picture};
        add(map);
        add(numbers(description, "tint", {color.x, color.y, color.z}));
    }
    add(numbers(description, "intensity", {environment.brightness}));
    return light;
}

}  // namespace

bool has_environment(const SceneDescription& description) {
    return description.environment &&
           std::ranges::count(description.hidden_default_lights, kEnvironment) == 0;
}

bool add_environment(Scene& scene, NodeTree& tree, Diagnostics& diagnostics) {
    SceneDescription& description = *scene.description;
    if (!has_environment(description)) return true;
    const EnvironmentDefinition environment = *description.environment;
    if (!look_at_picture(scene, environment, diagnostics)) return false;
    // Before NodeTree::add, which takes the description's values over into the scene.
    LightDefinition light = light_of(scene, environment);
    NodeDefinition place = node_of(description, environment);
    const uint32_t node = tree.add(std::move(place), kNone);
    description.lights.push_back(std::move(light));
    scene.lights.push_back({uint32_t(description.lights.size() - 1), node, kNone, kNone, kNone});
    return true;
}

}  // namespace kinora
