// runtime/scene/description/play_range.cpp: when a scene begins and ends, and its clips.
#include "runtime/scene/description/play_range.h"

#include <algorithm>

namespace kinora {

PlayRange play_range(const SceneDescription& description) {
    PlayRange range;
    anim::TimeRange keys = anim::time_range(description.animation);
    range.start = description.start_time.value_or(keys.begin);
    range.end = std::max(range.start, description.end_time.value_or(keys.end));
    range.rate = description.frame_rate.value_or(24.0);
    return range;
}

const ClipDefinition* find_clip(const SceneDescription& description, std::string_view name) {
    for (const ClipDefinition& clip : description.clips)
        if (clip.name == name) return &clip;
    for (const ClipDefinition& clip : description.clips)
        if (clip.id == name) return &clip;
    return nullptr;
}

void play_clip(SceneDescription& description, const ClipDefinition& clip) {
    description.start_time = clip.start;
    description.end_time = clip.end;
    if (!clip.animation) return;
    description.animation = *clip.animation;
    description.animated.assign(description.values.size(), false);
    for (const anim::Animation::Write& write : description.animation.writes)
        description.animated[write.slot] = true;
}

}  // namespace kinora
