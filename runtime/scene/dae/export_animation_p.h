// runtime/scene/dae/export_animation_p.h: channels as <animation>s, and what they need of their
// targets.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/curves/channels.h"
#include "runtime/scene/dae/export_clips_p.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

// XML names that no other element of the document has.
class UniqueNames {
  public:
    std::string name(const std::string& wanted, const char* kind);

  private:
    std::set<std::string> taken_;
};

// Numbers of an element, made of the description's values at a time.
using NumbersAt = std::function<std::vector<double>(const std::vector<double>& values)>;

// Elements say which numbers they hold; text() then addresses those that channels write.
class AnimationWriter {
  public:
    AnimationWriter(const SceneDescription& description, UniqueNames& names);

    // A channel writes one of the numbers: its element needs a sid.
    bool moves(ValueSlot slot) const;
    // Names the numbers: `target` alone, with `members` behind it, or with an index.
    void name(ValueSlot slot, const std::string& target, const char* const* members);

    // Names numbers that are made of slots; they are sampled. False where they never change.
    bool name_made(const std::string& target, std::span<const ValueSlot> slots,
                   const NumbersAt& numbers);

    // The unit axis about which a quaternion turns at all times. Nothing: another at each time.
    std::optional<dvec3> hinge(uint32_t quaternion) const;
    // Names a quaternion that stands as a <rotate> about this axis, or as a <matrix>.
    void name_rotation(uint32_t quaternion, const std::string& target, std::optional<dvec3> axis);

    // <animation>s and <animation_clip>s, and CONVERT_LOST for what cannot be said.
    CurveList::Text text(Diagnostics& diagnostics);
    // The <extra> of a visual scene with its times; "" where the keys have them. After text().
    std::string played_range() const;

  private:
    struct Target {
        std::string path, member;    // "node/translate0" and ".X"
        uint32_t first = 0;          // of the numbers that one channel may write together
        uint32_t count = 1;          // how many these are
        bool rotation = false;       // of a quaternion
        std::optional<dvec3> hinge;  // that stands as a <rotate> about it
    };
    std::vector<const anim::Sampler*> samplers_of(uint32_t quaternion) const;
    template <class F>
    void for_each_animation(F&& f) const;
    bool is_changed_by(const anim::Animation& animation, ValueSlot slot, const NumbersAt& numbers);
    Keys made_keys(const std::vector<MovingChannel>& channels, const NumbersAt& numbers);
    void add_made(const std::string& target, const Keys& keys, const std::vector<double>& rest,
                  uint32_t first, uint32_t clip);
    bool leaves_rest(const anim::Sampler& sampler, const anim::Channel& channel) const;
    void report_unnamed(Diagnostics& diagnostics) const;
    template <class F>
    void for_each_curve(const anim::Animation& animation, F&& add);
    void hold_still(Diagnostics& diagnostics);

    const SceneDescription& description_;
    UniqueNames& names_;
    std::map<uint32_t, Target> targets_;  // by offset in values
    std::vector<bool> animated_;          // per value: by the scene or a clip
    std::set<uint32_t> unnamed_, sampled_;
    ValuesAtTime values_;
    std::set<uint32_t> made_of_;     // values that made numbers follow
    std::vector<Target> made_;       // by their numbers in curves_, behind the values'
    std::vector<double> made_rest_;  // likewise
    CurveList curves_;
};

}  // namespace kinora
