// runtime/scene/ri/state/world_choice.h: which of a file's pictures are made, and of what.
#pragma once

#include <algorithm>
#include <memory>
#include <vector>

namespace kinora::ri {

class MeshStore;

// Worlds that are not drawn come without primitives.
struct WorldChoice {
    bool counts_alone = false;  // none is drawn; numbers and displays are all that is wanted
    std::vector<int> worlds;    // by their order in the file, from 0; none: all
    std::shared_ptr<MeshStore> meshes = {};  // of earlier readings with the same ImportOptions

    bool draws(int world) const {
        return !counts_alone && (worlds.empty() || std::ranges::count(worlds, world) > 0);
    }
};

}  // namespace kinora::ri
