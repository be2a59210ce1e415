// runtime/description/import_options.h: what the readers of scenes are asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/description/scene_description.h"

namespace kinora {

// Spec: opacity by the specification's formula. Auto: a material that the formula makes invisible
// everywhere is shown opaque, or by the mask of its texture (FX_TRANSPARENT_ALL is reported either
// way).
enum class TransparencyMode : uint8_t { Spec, Auto };

struct ImportOptions {
    TransparencyMode transparency = TransparencyMode::Auto;
    bool decode_colors = true;                     // COLLADA's display colours to linear light
    std::vector<std::string> allow_external;       // folders besides the scene's own tree
    bool confine = false;                          // pictures too: else they may lie anywhere
    std::optional<UpAxis> up_axis;                 // instead of the file's
    std::optional<double> meter;                   // instead of the file's
    std::vector<std::string> include_directories;  // for #include in shaders
};

// Limits what the scene's shaders may read and write to its folder ("" is the current one) and what
// the options allow.
void limit_files(SceneDescription& description, const std::string& folder,
                 const ImportOptions& options);

}  // namespace kinora
