// runtime/dae/export_animation_p.h: channels as <animation>s, and what they need of their targets.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include "runtime/base/diagnostic.h"
#include "runtime/description/scene_description.h"

namespace kinora {

// XML names that no other element of the document has.
class UniqueNames {
  public:
    std::string name(const std::string& wanted, const char* kind);

  private:
    std::set<std::string> taken_;
};

// Elements say which numbers they hold; text() then addresses those that channels write.
class AnimationWriter {
  public:
    AnimationWriter(const SceneDescription& description, UniqueNames& names)
        : description_(description), names_(names) {}

    // A channel writes one of the numbers: its element needs a sid.
    bool moves(ValueSlot slot) const;
    // Names the numbers: `target` alone, with `members` behind it, or with an index.
    void name(ValueSlot slot, const std::string& target, const char* const* members);

    // The unit axis about which a quaternion turns at all times. Nothing: another at each time.
    std::optional<dvec3> hinge(uint32_t quaternion) const;
    // Names a quaternion that stands as a <rotate> about this axis, or as a <matrix>.
    void name_rotation(uint32_t quaternion, const std::string& target, std::optional<dvec3> axis);

    // <animation>s, and CONVERT_LOST for what cannot be said.
    std::string text(Diagnostics& diagnostics);

  private:
    struct Target {
        std::string path, member;    // "node/translate0" and ".X"
        uint32_t first = 0;          // of the numbers that one channel may write together
        uint32_t count = 1;          // how many these are
        bool rotation = false;       // of a quaternion
        std::optional<dvec3> hinge;  // that stands as a <rotate> about it
    };
    const anim::Sampler* sampler_of(uint32_t quaternion) const;

    const SceneDescription& description_;
    UniqueNames& names_;
    std::map<uint32_t, Target> targets_;  // by offset in values
};

// Degrees about a unit axis, of a rotation about it.
double angle_about(const dvec3& axis, const double* quaternion);

}  // namespace kinora
