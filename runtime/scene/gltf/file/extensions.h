// runtime/scene/gltf/file/extensions.h: what is known of glTF's extensions.
#pragma once

#include "runtime/scene/gltf/file/file.h"

namespace kinora {

// Reports the extensions of the file that are not understood. False where one of those it requires
// may change what is drawn, unless options.ignore_required.
bool check_extensions(const GltfFile& file, const ImportOptions& options, Diagnostics& diagnostics);

}  // namespace kinora
