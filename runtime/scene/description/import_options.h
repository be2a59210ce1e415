// runtime/scene/description/import_options.h: what the readers of scenes are asked for.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

// Spec: opacity by the specification's formula. Auto: a material that the formula makes invisible
// everywhere is shown opaque, or by the mask of its texture (FX_TRANSPARENT_ALL is reported either
// way).
enum class TransparencyMode : uint8_t { Spec, Auto };

// Spec: <emission> is light of its own color. Auto: in files that Blender wrote before 2.80 it is a
// factor of the diffuse color.
enum class EmissionMode : uint8_t { Spec, Auto };

inline constexpr double kCurveError = 0.25;

// Faces that meet at less than this many degrees are smooth where a COLLADA file has no normals.
inline constexpr double kCreaseDegrees = 40;

struct ImportOptions {
    TransparencyMode transparency = TransparencyMode::Auto;
    EmissionMode emission = EmissionMode::Auto;
    bool ignore_required = false;  // extensions that a glTF file requires and nothing here knows
    bool vertex_colors = true;     // tint the materials that are no RSL of the file
    // Degrees: normals for meshes without any (0 flat, 180 all smooth). Nothing: kCreaseDegrees,
    // but flat for glTF (glTF 2.0, 3.7.2.1).
    std::optional<double> smooth;
    bool decode_colors = true;                     // COLLADA's display colours to linear light
    std::vector<std::string> allow_external;       // folders besides the scene's own tree
    bool confine = false;                          // pictures too: else they may lie anywhere
    std::optional<UpAxis> up_axis;                 // instead of the file's
    std::optional<double> meter;                   // instead of the file's
    std::vector<std::string> include_directories;  // for #include in shaders
    int world = -1;  // of a RIB file with several pictures, from 0; -1: the last
    // The picture that curved surfaces are made triangles for: pixels across and down (0, 0: as a
    // RIB file says), times `scale`, and how many of these lie between a curve and its triangles.
    int width = 0, height = 0;
    double scale = 1;
    double curve_error = kCurveError;
};

// Limits what the scene's shaders may read and write to its folder ("" is the current one) and what
// the options allow.
void limit_files(SceneDescription& description, const std::string& folder,
                 const ImportOptions& options);

}  // namespace kinora
