// runtime/scene/dae/export.h: a SceneDescription (one that import_gltf made) as a COLLADA document.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct ColladaExport {
    // COLLADA 1.4.1, a line for each element (collada::Layout::Lines); "" where no reader would
    // take it, with findings.
    std::string text;
    // Images that were inside the scene's file: names relative to the document, and bytes.
    std::vector<std::pair<std::string, std::string>> files;
};

// `path` is where the document will stand: image links are relative to it.
//
// Nodes keep their stacks. A quaternion that always turns about one axis becomes a <rotate>,
// another a <matrix>, whose LINEAR keys turn as glTF's do.
// Curves become LINEAR, STEP or BEZIER with the same values at all times. COLLADA's own shading
// models and lights are written as such. glTF's become the nearest of them (nearest_common.h). RSL
// is written as profile_RSL with its code, beside a profile_COMMON that comes near. Colours of
// light are encoded as display colours. What cannot be said gives CONVERT_LOST.
ColladaExport export_collada(const SceneDescription& description, const std::string& path,
                             Diagnostics& diagnostics);

}  // namespace kinora
