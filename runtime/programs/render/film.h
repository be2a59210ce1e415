// runtime/programs/render/film.h: the pictures of a RIB file, one run each.
#pragma once

#include "runtime/programs/render/options.h"

namespace kinora {

// The exit code. The run ends with the first picture that fails, unless --keep-going is given.
int render_worlds(const RenderOptions& options);

}  // namespace kinora
