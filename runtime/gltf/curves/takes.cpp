// runtime/gltf/curves/takes.cpp: what becomes an animation of glTF.
#include "runtime/gltf/curves/takes.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace kinora {

std::vector<Take> find_takes(const SceneDescription& description, LossReport& losses) {
    std::vector<Take> takes;
    std::set<uint32_t> driven, played;
    bool whole = true;
    for (const ClipDefinition& clip : description.clips) {
        if (!clip.animation) continue;
        takes.push_back({clip.name, clip.animation.get()});
        anim::TimeRange range = anim::time_range(*clip.animation);
        whole &= range.begin == clip.start && range.end == clip.end;
        const std::vector<anim::Channel>& channels = clip.animation->channels;
        bool meets = std::any_of(channels.begin(), channels.end(),
                                 [&](const anim::Channel& c) { return driven.contains(c.slot); });
        for (const anim::Channel& c : channels)
            if (!meets) driven.insert(c.slot);
    }
    for (const anim::Channel& c : description.animation.channels) played.insert(c.slot);
    if (takes.empty() || !whole || driven != played) {
        for (const Take& take : takes)
            losses.lost(fmt::format("clip '{}'", take.name),
                        "that it moves a part of the scene (all of it)");
        takes = {{"", &description.animation}};
    }
    return takes;
}

}  // namespace kinora
