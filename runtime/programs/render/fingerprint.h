// runtime/programs/render/fingerprint.h: what a picture depends on, for --skip-existing.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/base/files/content_hash.h"
#include "runtime/programs/render/options.h"

namespace kinora {

// Hashes that the pictures of one file share.
struct KnownHashes {
    std::vector<uint64_t> texts;  // of the first source files, which all have
    FileHashes files;
};

// A hash of what was read: the texts, of which the first `shared` are those of all pictures, and
// the contents of the scene's file, of textures, buffers and other files. Before the first frame:
// the names that strings of shaders are then are the same at each run.
uint64_t hash_inputs(const SourceFiles& texts, const SceneDescription& description,
                     const std::string& scene, KnownHashes& known, FileId shared);

// Sixteen hexadecimal digits: what was read, the options, the program's build, the picture's size,
// the frames per second, the time.
std::string fingerprint(const RenderOptions& options, uint64_t inputs, int width, int height,
                        double rate, double time);

}  // namespace kinora
