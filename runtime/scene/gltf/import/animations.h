// runtime/scene/gltf/import/animations.h: glTF's animations as channels; each is a clip.
#pragma once

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "anim/animation.h"
#include "runtime/scene/gltf/import/accessor_reader.h"
#include "runtime/scene/gltf/import/node_properties.h"
#include "runtime/scene/gltf/import/node_tree.h"
#include "runtime/scene/gltf/import/unique_ids.h"
#include "runtime/scene/gltf/pointers/pointer_slots.h"

namespace kinora {

class AnimationImporter {
  public:
    // `slots`: per node, what its channels write.
    AnimationImporter(const tinygltf::Model& model, const GltfNodeTree& tree,
                      const std::vector<NodeSlots>& slots, const PointerSlots& pointers,
                      AccessorReader& accessors, GltfReport& report, ByteBudget& budget,
                      SceneDescription& out)
        : model_(model),
          tree_(tree),
          slots_(slots),
          pointers_(pointers),
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
        ValueSlot slot;
        uint32_t owner = 0;
    };
    struct Output {  // what a sampler is of
        uint32_t width;
        double scale = 1;  // of its numbers
        bool is_rotation = false, is_list = false;
    };
    struct Made {  // of one animation
        std::vector<anim::Sampler> samplers;
        std::vector<anim::Channel> channels;
        std::deque<anim::Sampler> values;  // of the file, that formulas read
        // By follower: the sampler of each of its values, or null.
        std::map<uint32_t, std::vector<const anim::Sampler*>> formulas;
    };
    Written written_by(uint32_t node, const std::string& path) const;
    std::optional<anim::Sampler> sampler_of(uint32_t animation, uint32_t channel,
                                            const Output& output);
    void import_node_channel(uint32_t animation, uint32_t channel, uint32_t node,
                             const std::string& path, Made& made);
    void import_pointer(uint32_t animation, uint32_t channel, const std::string& pointer,
                        Made& made);
    void import_formulas(uint32_t animation, Made& made);
    void add_followers(const SlotFollower& follower, anim::Sampler sampler, Made& made) const;
    anim::Animation animation_of(uint32_t index);
    void add_clip(uint32_t animation, std::shared_ptr<const anim::Animation> own, UniqueIds& ids);

    const tinygltf::Model& model_;
    const GltfNodeTree& tree_;
    const std::vector<NodeSlots>& slots_;
    const PointerSlots& pointers_;
    AccessorReader& accessors_;
    GltfReport& report_;
    ByteBudget& budget_;
    SceneDescription& out_;
    std::vector<uint32_t> clip_of_;  // by animation
};

}  // namespace kinora
