// runtime/programs/render/worlds.h: the pictures of a RIB file, each a frame.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/programs/render/options.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

// The file's pictures that are wanted, from 0: those that --frames names, all where -o has a frame
// token, else the last. Nothing, with a message on stderr: the file has none of these frames. An
// empty list: it has no pictures at all.
std::optional<std::vector<int>> worlds_to_render(const RenderOptions& options);

// One of them, as it was read.
struct ReadWorld {
    RenderOptions options;  // of its frame alone
    SceneDescription scene;
    double ms = 0;             // that it took to read
    const Diagnostics& found;  // in the file up to its end
};

// Reads the file once, and gives each of these pictures to `render`, until that returns false.
// False: the file cannot be read; `found` says why.
bool read_worlds(const RenderOptions& options, const std::vector<int>& worlds, Diagnostics& found,
                 const std::function<bool(ReadWorld world)>& render);

}  // namespace kinora
