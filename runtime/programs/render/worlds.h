// runtime/programs/render/worlds.h: the pictures of a RIB file, each a frame.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "raytrace/film.h"
#include "runtime/base/diagnostic.h"
#include "runtime/kinora/map_worlds.h"
#include "runtime/programs/render/fingerprint.h"
#include "runtime/programs/render/options.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

struct ChosenWorlds {
    std::vector<int> wanted;    // from 0
    std::map<int, int> passes;  // how many of them a frame has, by its number
    // Earlier ones whose displays of these names are looked up by them, or by others of these.
    MapWorlds maps;
    // Of displays that several of the file's pictures have, wanted or not (display_stem()).
    std::set<std::string> shared_stems;
};
// The file's pictures that are wanted: those that --frames names, all where -o has a frame token,
// else the last. Nothing, with a message on stderr: the file has none of these frames. None: it has
// no pictures at all.
std::optional<ChosenWorlds> worlds_to_render(const RenderOptions& options);

// One of them, as it was read.
struct ReadWorld {
    RenderOptions options;  // of its frame alone
    SceneDescription scene;
    double ms = 0;             // that it took to read
    const Diagnostics& found;  // in the file up to its end
    KnownHashes& hashes;       // of the file's pictures
    const std::set<std::string>& shared_stems;
    // Gets its picture; empty: nobody needs it but its file.
    std::function<void(const raytrace::Film& film)> keep;
};

// Reads the file once, and gives each wanted picture to `render`, until that returns false. Maps
// that they need are rendered before, and stay in memory.
// False: the file cannot be read; `found` says why.
bool read_worlds(const RenderOptions& options, const ChosenWorlds& worlds, Diagnostics& found,
                 const std::function<bool(ReadWorld world)>& render);

}  // namespace kinora
