// runtime/scene/gltf/export/occurrences.h: the unrolled tree of nodes.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/scene/gltf/export/nodes.h"

namespace kinora {

// An occurrence of a node definition in the unrolled tree.
struct Occurrence {
    uint32_t definition;
    uint32_t parent;   // kNone: a root
    uint32_t node;     // the glTF node with its whole matrix: what children hang on
    dmat4 world;       // at rest, in the scene's own axes and unit
    dmat4 start;       // likewise, at the first keys
    dmat4 conversion;  // of its use, outside its own stack
    bool hidden;       // by its node or one above
};

class Occurrences {
  public:
    // Writes the nodes of the scene below `root` (kNone: the scene itself).
    Occurrences(const SceneDescription& description, uint32_t root, NodeWriter& nodes,
                GltfDocument& document);

    uint32_t size() const { return uint32_t(all_.size()); }
    const Occurrence& operator[](uint32_t index) const { return all_[index]; }
    auto begin() const { return all_.begin(); }
    auto end() const { return all_.end(); }

    // That of a definition which shares the lowest node with `from`; kNone: there is none.
    uint32_t nearest(uint32_t definition, uint32_t from) const;

  private:
    void unroll(uint32_t definition, uint32_t parent, const dmat4& conversion);

    const SceneDescription& description_;
    uint32_t root_;
    NodeWriter& nodes_;
    GltfDocument& document_;
    std::vector<double> start_values_;  // at the first keys
    std::vector<Occurrence> all_;       // parents before children
};

}  // namespace kinora
