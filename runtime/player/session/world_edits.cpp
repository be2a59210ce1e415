// runtime/player/session/world_edits.cpp: which edits have something to change.
#include "runtime/player/session/world_edits.h"

#include <algorithm>

#include "runtime/player/session/shader_places.h"
#include "runtime/scene/description/default_lights.h"
#include "runtime/scene/load/override_scene.h"

namespace kinora {

namespace {

using Places = std::vector<ShaderPlace>;

bool has_parameter_so_far(const ShaderPlace& place, const std::string& name) {
    return place.use && place.use->shader &&
           std::ranges::any_of(place.use->shader->parameters,
                               [&](const rsl::ShaderParameter& p) { return p.name == name; });
}

// An edited text may have any parameters.
bool is_edited(const ShaderPlace& place, const SceneEdits& edits) {
    return std::ranges::count(edits.texts, place.id, &SceneEdits::Text::material) > 0 ||
           std::ranges::any_of(edits.shaders, [&](const auto& edit) {
               return glob_matches(edit.first, place.id, place.name);
           });
}

bool has_parameter_of(const Places& places, const SceneEdits& edits, const std::string& target) {
    const size_t dot = std::min(target.rfind('.'), target.size());
    const std::string wearer = target.substr(0, dot),
                      name = target.substr(std::min(dot + 1, target.size()));
    return std::ranges::any_of(places, [&](const ShaderPlace& place) {
        return glob_matches(wearer, place.target, place.name) &&
               (has_parameter_so_far(place, name) || is_edited(place, edits));
    });
}

bool has_node(const SceneDescription& description, const std::string& pattern) {
    return pattern == kDefaultLightNode ||
           std::ranges::any_of(description.nodes, [&](const NodeDefinition& node) {
               return glob_matches(pattern, node.id, node.name);
           });
}

}  // namespace

SceneEdits edits_of_world(const SceneEdits& edits, const SceneDescription& description) {
    const Places places = shader_places(description);
    SceneEdits kept = edits;
    std::erase_if(kept.shaders, [&](const auto& edit) {
        return std::ranges::none_of(places, [&](const ShaderPlace& place) {
            return glob_matches(edit.first, place.id, place.name);
        });
    });
    std::erase_if(kept.texts, [&](const SceneEdits::Text& text) {
        return std::ranges::count(places, text.material, &ShaderPlace::id) == 0;
    });
    std::erase_if(kept.params,
                  [&](const auto& edit) { return !has_parameter_of(places, kept, edit.first); });
    std::erase_if(kept.hidden,
                  [&](const std::string& node) { return !has_node(description, node); });
    return kept;
}

}  // namespace kinora
