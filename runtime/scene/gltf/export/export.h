// runtime/scene/gltf/export/export.h: a SceneDescription as a binary glTF 2.0 file.
#pragma once

#include <string>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/rsl_literals.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct GltfExportOptions {
    FileLink link;  // how code names files; none leaves the names as they are
    // Where a curve is none that glTF knows, it is sampled until straight pieces (slerp for
    // rotations) stay this near: translations and weights relative to the range they move over,
    // scales to their size, rotations in radians.
    double animation_error = 1e-4;
};

// The bytes of a .glb. Axes and unit become the matrix of one root node (none if the scene has
// glTF's: metres, y up), whose extras.kinora_axes has import_gltf take them off again, so that
// shaders find the world they were written for. instance_node trees are unrolled, since a glTF node
// has one parent. JSON pointers drive what moves of materials, lights, cameras and RSL parameters
// (KHR_animation_pointer). LINEAR and STEP curves of translations, scales, weights and turns about
// one axis come out exact, so do cubics with times at the thirds (CUBICSPLINE) of all but
// rotations.
//
// Materials: base color = diffuse (<constant>: emission, with KHR_materials_unlit), emissive =
// emission, metallic 0; roughness^4 = 2 / (n + 2), which makes GGX as wide as a Blinn highlight of
// exponent n (Walter 2007), n = shininess for <blinn>, 4 shininess for <phong>; 1 for <lambert>,
// which reflects nothing else; KHR_materials_specular with the specular color; opaque modes become
// alpha. The shading model itself, lights' attenuation and RSL go into extras.kinora_rsl, which
// import_gltf reads, with a finding CONVERT_EXTRAS; what nothing keeps gives CONVERT_LOST.
std::string export_glb(const SceneDescription& description, const GltfExportOptions& options,
                       Diagnostics& diagnostics);

}  // namespace kinora
