// runtime/scene/dae/import.h: a COLLADA file to a SceneDescription.
#pragma once

#include <optional>
#include <string>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/import_options.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/description/scene_source.h"

namespace kinora {

// Reads the document (a .dae, .zae or .kmz), extracts what <scene> reaches and compiles every
// shader bound there. Findings have their locations in the .dae, also those inside shader code.
// Nothing is returned when there is no scene to show; errors that leave a scene (a shader that does
// not compile: its material becomes the default one) are in `diagnostics`.
std::optional<SceneDescription> import_collada(const SceneSource& source,
                                               const ImportOptions& options,
                                               Diagnostics& diagnostics);

}  // namespace kinora
