// runtime/scene/gltf/export/skins.h: skins with the nodes of their joints.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "runtime/base/skin_space.h"
#include "runtime/scene/gltf/document/buffer_writer.h"
#include "runtime/scene/gltf/export/occurrences.h"

namespace kinora {

class SkinWriter {
  public:
    // `root`: the node that stands for the world (kNone: none).
    SkinWriter(const SceneDescription& description, uint32_t root, const Occurrences& occurrences,
               NodeWriter& nodes, GltfDocument& document, BufferWriter& buffer)
        : description_(description),
          root_(root),
          occurrences_(occurrences),
          nodes_(nodes),
          document_(document),
          buffer_(buffer) {}

    // The skin of a mesh that hangs on an occurrence; `about` takes its written positions to the
    // file's.
    uint32_t write(const MeshUse& use, const dmat4& about, uint32_t occurrence);

  private:
    using Copies = std::map<uint32_t, uint32_t>;  // occurrence -> its node once more
    std::vector<uint32_t> joints_of(const MeshUse& use, uint32_t occurrence) const;
    SkinPlacement space_of(const MeshUse& use, uint32_t occurrence, std::span<const uint32_t> bound,
                           uint32_t shared) const;
    dmat4 path_conversion(uint32_t occurrence) const;
    dmat4 inverse_bind(const SkinDefinition& skin, size_t j, uint32_t joint,
                       const dmat4& from_skin) const;
    uint32_t copy(uint32_t occurrence, uint32_t above, uint32_t top, Copies& copies);

    const SceneDescription& description_;
    uint32_t root_;
    const Occurrences& occurrences_;
    NodeWriter& nodes_;
    GltfDocument& document_;
    BufferWriter& buffer_;
};

// The joints of a skin have a common root (glTF 2.0, 3.7.3.1), which a scene's roots are not: where
// they need one, all that is no skinned mesh hangs below a node that does nothing.
void give_skins_a_root(GltfDocument& document);

}  // namespace kinora
