// runtime/scene/dae/export_clips_p.h: curves of clips and of the scene as <animation>s and
// <animation_clip>s.
//
// A reader plays all animations where no clip is chosen, and of two that write one number the last.
// So the curves of the scene's own animation stand behind those that play in clips alone.
#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "anim/animation.h"
#include "runtime/scene/dae/export_keys_p.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

class UniqueNames;

// A <sampler> with its <channel>.
struct WrittenCurve {
    std::string target;
    Keys keys;
    std::vector<uint32_t> numbers;  // of the description's values, that it drives
    std::set<uint32_t> clips;       // that it plays in
    bool in_scene = false;          // it plays without a clip
};

class CurveList {
  public:
    // A curve that plays in a clip, or in the scene (kNone). Equal ones are one.
    void add(WrittenCurve curve, uint32_t clip);

    // Numbers that a clip drives and the scene does not.
    std::vector<uint32_t> moved_by_clips_alone() const;
    // A clip all of whose curves play in the scene; kNone: there is none.
    uint32_t clip_of_scene(const SceneDescription& description) const;
    // Whether a clip has keys outside this range.
    bool leaves(const anim::TimeRange& range) const;

    // The contents of <library_animations> and <library_animation_clips>.
    struct Text {
        std::string animations, clips;
    };
    Text text(const SceneDescription& description, UniqueNames& names) const;

  private:
    std::vector<WrittenCurve> curves_;
    std::map<std::string, size_t> known_;
};

}  // namespace kinora
