// runtime/picture/lights/light_tree.h: a few of many lamps for a point, by what each can send
// there.
//
// A tree over the lamps tells how much light may come from each part of them. For a point the tree
// is opened where much may come or little is known, and the parts are laid in a row, each as long
// as its light. Points at equal steps along the row choose the lamps. A lamp that alone is as long
// as a step is taken for certain, and within a part the way down is chosen by the same number. Each
// lamp counts as one over the number of times that it is chosen on average. So the mean over all
// starts is the sum over all lamps, whatever the tree thinks of them.
//
// A. Conty Estevez and C. Kulla, Importance Sampling of Many Lights with Adaptive Tree Splitting,
// 2018, open trees in this way; theirs choose one light of each part by itself.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/base/arena.h"
#include "runtime/picture/lights/lamp.h"
#include "runtime/picture/lights/lamp_kernels.h"

namespace kinora {

// The most lamps that are chosen for a point.
inline constexpr size_t kMostChosen = 64;

class LightTree {
  public:
    // Lamps without strength are never chosen. Allocates nothing where as many were built before.
    void build(std::span<const Lamp> lamps);
    bool empty() const { return blocks_.empty(); }
    // Up to `wanted` lamps for each point, by their numbers when the tree was built, those of a
    // point in its order; how many in all. `chosen` has room for them. What a point chooses does
    // not depend on those beside it.
    size_t choose(const LampPoints& points, size_t wanted, Arena& arena,
                  std::span<ChosenLamp> chosen) const;

  private:
    // Lamps of order_.
    struct Group {
        uint32_t first, count;
    };
    uint32_t add(Group group);
    Group split(Group& group);

    std::vector<Lamp> lamps_;
    std::vector<uint32_t> order_;    // lamps, as the tree has them beside each other
    std::vector<LampBlock> blocks_;  // the first holds all
};

}  // namespace kinora
