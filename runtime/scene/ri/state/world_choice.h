// runtime/scene/ri/state/world_choice.h: which of a file's pictures are made.
#pragma once

#include <algorithm>
#include <vector>

namespace kinora::ri {

// Worlds that are not drawn come without primitives.
struct WorldChoice {
    bool counts_alone = false;  // none is drawn; numbers and displays are all that is wanted
    std::vector<int> worlds;    // by their order in the file, from 0; none: all

    bool draws(int world) const {
        return !counts_alone && (worlds.empty() || std::ranges::count(worlds, world) > 0);
    }
};

}  // namespace kinora::ri
