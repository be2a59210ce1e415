// runtime/programs/render/fingerprint.h: what a picture depends on, for --skip-existing.
#pragma once

#include <cstdint>
#include <string>

#include "runtime/base/diagnostic.h"
#include "runtime/programs/render/options.h"

namespace kinora {

// A hash of what was read: the texts, and the contents of the scene's file, of textures, buffers
// and other files. Before the first frame: the names that strings of shaders are then are the same
// at each run.
uint64_t hash_inputs(const SourceFiles& texts, const SceneDescription& description,
                     const std::string& scene);

// Sixteen hexadecimal digits: what was read, the options, the program's build, the picture's size,
// the frames per second, the time.
std::string fingerprint(const RenderOptions& options, uint64_t inputs, int width, int height,
                        double rate, double time);

}  // namespace kinora
