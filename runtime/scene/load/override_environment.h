// runtime/scene/load/override_environment.h: what lies around the scene, as options say.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct EnvironmentGiven {
    std::string what;  // a picture, R,G,B, FILE.sl, a light of ours, "none", or "": as it is
    std::optional<double> rotation, brightness;
    bool hidden = false;
    std::vector<std::string> include_directories = {};  // of FILE.sl

    bool any() const { return !what.empty() || rotation || brightness || hidden; }
};

// Three numbers with commas.
std::optional<dvec3> parse_environment_color(const std::string& text);

// False after an error, which is a finding.
bool override_environment(SceneDescription& description, const EnvironmentGiven& given,
                          Diagnostics& diagnostics);

}  // namespace kinora
