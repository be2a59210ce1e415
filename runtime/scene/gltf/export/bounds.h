// runtime/scene/gltf/export/bounds.h: the scene's axes and size in glTF's space.
#pragma once

#include "runtime/scene/gltf/export/occurrences.h"

namespace kinora {

// From the scene's axes and unit to glTF's: metres, y up.
dmat4 gltf_axes(const SceneDescription& description);

// At rest, in glTF's space: for what needs a length, near planes and lights without falloff.
struct SceneBounds {
    double radius = 1;
    dvec3 center{0.0};
};
SceneBounds bounds_of(const SceneDescription& description, const Occurrences& occurrences,
                      const dmat4& axes);

}  // namespace kinora
