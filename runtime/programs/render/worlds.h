// runtime/programs/render/worlds.h: the pictures of a RIB file, each a frame.
#pragma once

#include <vector>

#include "runtime/programs/render/options.h"

namespace kinora {

// The file's pictures as options of a run each: those that --frames names, all where -o has a frame
// token, else the last. Empty, with a message on stderr: the file has none of these frames.
std::vector<RenderOptions> runs_of_worlds(const RenderOptions& options);

}  // namespace kinora
