// runtime/import_options.h: what the readers of scenes are asked for.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/scene_description.h"

namespace kinora {

struct ImportOptions {
    std::vector<std::string> allow_external;       // folders besides the scene's own tree
    std::optional<UpAxis> up_axis;                 // instead of the file's
    std::optional<double> meter;                   // instead of the file's
    std::vector<std::string> include_directories;  // for #include in shaders
};

}  // namespace kinora
