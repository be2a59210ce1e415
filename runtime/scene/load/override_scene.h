// runtime/scene/load/override_scene.h: what a command line changes of a scene before it is built:
// --param,
// --hide and --only. Names are globs (* ? [...]) of ids or names.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

// Whether the glob fits the id or the name of something.
bool glob_matches(const std::string& pattern, const std::string& id, const std::string& name);

// "1,0.5 0.25" as numbers; nothing if it is not that.
std::optional<std::vector<double>> parse_numbers(std::string_view text);

// --param MATERIAL.NAME=VALUE: `target` is MATERIAL.NAME; every shader of the materials (and of the
// lights, atmospheres and imagers, these two by their shader's name) that fit gets the value,
// instead of what the scene gives or animates. One number fills a triple. False after an error,
// which is a finding.
bool override_param(SceneDescription& description, const std::string& target,
                    const std::string& value, Diagnostics& diagnostics);

// --hide NODE: what hangs on these nodes and below them (meshes, lights) is not there. Default
// lights have names, too (description/default_lights.h).
// --only NODE: meshes elsewhere are not there; lights and cameras stay. False after an error.
bool override_visibility(SceneDescription& description, const std::vector<std::string>& hide,
                         const std::vector<std::string>& only, Diagnostics& diagnostics);

}  // namespace kinora
