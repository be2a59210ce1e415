// runtime/scene/build/instances/light_groups.cpp: lights found by their names.
#include "runtime/scene/build/instances/light_groups.h"

#include <fnmatch.h>

#include <algorithm>
#include <cctype>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/names.h"
#include "runtime/scene/scene.h"

namespace kinora {

namespace {

bool is_name(std::string_view text) {
    return !text.empty() && std::ranges::all_of(text, [](char c) {
        return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '-';
    });
}

std::vector<std::string> split_patterns(std::string_view text) {
    std::vector<std::string> patterns;
    while (!text.empty()) {
        const size_t end = std::min(text.find(','), text.size());
        patterns.emplace_back(text.substr(0, end));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return patterns;
}

// By any name of the light or its node.
bool matches(const Scene& scene, const LightSource& source, const std::string& pattern) {
    const LightDefinition& light = scene.description->lights[source.definition];
    const NodeDefinition& node = scene.description->nodes[scene.nodes[source.node].definition];
    return std::ranges::any_of(
        std::initializer_list<const std::string*>{&light.id, &light.name, &node.id, &node.name},
        [&](const std::string* name) {
            return !name->empty() && fnmatch(pattern.c_str(), name->c_str(), 0) == 0;
        });
}

}  // namespace

std::vector<LightGroup> single_lights(const Scene& scene) {
    std::vector<LightGroup> groups;
    for (std::string& name : light_aov_names(scene, scene))
        groups.push_back({std::move(name), {uint32_t(groups.size())}});
    return groups;
}

std::vector<LightGroup> light_groups(const Scene& scene, Diagnostics& diagnostics) {
    std::vector<LightGroup> groups;
    for (const std::string& text : scene.options.light_groups) {
        const size_t name = std::min(text.find('='), text.size());
        const std::vector<std::string> patterns =
            split_patterns(std::string_view(text).substr(std::min(name + 1, text.size())));
        if (!is_name(text.substr(0, name)) || patterns.empty()) {
            diagnostics.report(Code::LIGHT_GROUP_FORM, Location{}, text);
            continue;
        }
        LightGroup group{text.substr(0, name), {}};
        for (const std::string& pattern : patterns) {
            bool any = false;
            for (uint32_t l = 0; l < scene.lights.size(); ++l) {
                if (!matches(scene, scene.lights[l], pattern)) continue;
                any = true;
                if (std::ranges::count(group.lights, l) == 0) group.lights.push_back(l);
            }
            if (!any) diagnostics.report(Code::LIGHT_GROUP_EMPTY, Location{}, text, pattern);
        }
        groups.push_back(std::move(group));
    }
    return groups;
}

}  // namespace kinora
