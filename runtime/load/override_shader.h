// runtime/load/override_shader.h: --shader MATERIAL=FILE.sl: a shader tried on without editing the
// scene.
#pragma once

#include <string>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/description/scene_description.h"

namespace kinora {

// Compiles FILE.sl and puts its surface (or displacement) shader on every material whose id or name
// matches the glob `pattern`; parameters of the same name keep their sources. Errors are findings;
// false then. A pattern that matches nothing is an error, "*" also reaches the default material.
bool override_shader(SceneDescription& description, const std::string& pattern,
                     const std::string& file, const std::vector<std::string>& include_directories,
                     Diagnostics& diagnostics);

// --imager: the picture is run through that imager instead of the scene's: "none", the name of a
// standard one (assets/shaders), or a file with an imager shader. False when there is no such.
bool override_imager(SceneDescription& description, const std::string& name,
                     const std::vector<std::string>& include_directories, Diagnostics& diagnostics);

}  // namespace kinora
