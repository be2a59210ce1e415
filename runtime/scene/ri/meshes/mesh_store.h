// runtime/scene/ri/meshes/mesh_store.h: meshes of primitives that a file has in several pictures.
#pragma once

#include <cstdint>
#include <map>
#include <memory>

#include "runtime/scene/description/scene_description.h"

namespace kinora::ri {

// What decides a primitive's mesh: content_of() its call, and the pixels of a unit that it was made
// for (0: as fine as its numbers say).
struct MeshKey {
    uint64_t content = 0;
    double pixels = 0;
    auto operator<=>(const MeshKey&) const = default;
};

// Meshes that are costly to make, from one world to the next.
class MeshStore {
  public:
    std::shared_ptr<const MeshDefinition> find(const MeshKey& key);
    void keep(const MeshKey& key, const MeshDefinition& mesh);
    // A world begins: frees what the last two did not use.
    void begin_world();

  private:
    struct Entry {
        std::shared_ptr<const MeshDefinition> mesh;
        uint64_t used;  // the world, by its number
    };
    std::map<MeshKey, Entry> entries_;
    uint64_t world_ = 0;
};

}  // namespace kinora::ri
