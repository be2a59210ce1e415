// runtime/gltf/import/animations.h: glTF's animations as channels; each is a clip.
#pragma once

#include <optional>
#include <vector>

#include "anim/animation.h"
#include "runtime/gltf/import/accessor_reader.h"
#include "runtime/gltf/import/node_properties.h"
#include "runtime/gltf/import/node_tree.h"
#include "runtime/gltf/import/unique_ids.h"

namespace kinora {

class AnimationImporter {
  public:
    // `slots`: per node, what its channels write.
    AnimationImporter(const tinygltf::Model& model, const GltfNodeTree& tree,
                      const std::vector<NodeSlots>& slots, AccessorReader& accessors,
                      GltfReport& report, ByteBudget& budget, SceneDescription& out)
        : model_(model),
          tree_(tree),
          slots_(slots),
          accessors_(accessors),
          report_(report),
          budget_(budget),
          out_(out) {}

    // All at once; an animation that drives what an earlier one drives is left to --clip.
    void import_animations(UniqueIds& ids);

    // The clip of each animation; kNone where it is none.
    std::span<const uint32_t> clips() const { return clip_of_; }

  private:
    struct Written {  // what a channel writes
        uint32_t slot = kNone, count = 0, owner = 0;
    };
    Written written_by(const tinygltf::AnimationChannel& channel) const;
    std::optional<anim::Sampler> sampler_of(uint32_t animation, uint32_t channel, uint32_t stride);
    anim::Animation animation_of(uint32_t index);
    void add_clip(uint32_t animation, std::shared_ptr<const anim::Animation> own, UniqueIds& ids);

    const tinygltf::Model& model_;
    const GltfNodeTree& tree_;
    const std::vector<NodeSlots>& slots_;
    AccessorReader& accessors_;
    GltfReport& report_;
    ByteBudget& budget_;
    SceneDescription& out_;
    std::vector<uint32_t> clip_of_;  // by animation
};

}  // namespace kinora
