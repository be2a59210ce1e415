// runtime/scene/gltf/export/scene_extras.cpp: what of a scene glTF has no words for.
#include "runtime/scene/gltf/export/scene_extras.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace kinora {

namespace {

// Clips that are ranges of the scene's animation, and ranges of clips that are animations where
// these are not those of their keys.
Json clip_ranges(const SceneDescription& description, std::span<const Take> takes,
                 const CurveWriter& curves) {
    Json ranges = Json::array();
    for (const ClipDefinition& clip : description.clips) {
        Json range = {{"name", clip.name}, {"start", clip.start}, {"end", clip.end}};
        bool is_keys = false;
        uint32_t animation = 0;
        for (uint32_t t = 0; t < takes.size(); ++t) {
            if (!curves.has_channels(t)) continue;
            if (clip.animation && takes[t].animation == clip.animation.get()) {
                anim::TimeRange keys = anim::time_range(*clip.animation);
                is_keys = keys.begin == clip.start && keys.end == clip.end;
                range["animation"] = animation;
            }
            ++animation;
        }
        if (!is_keys) ranges.push_back(range);
    }
    return ranges;
}

}  // namespace

void write_scene_shaders(const SceneDescription& description, RslWriter& rsl,
                         GltfDocument& document, LossReport& losses) {
    Json shaders = rsl.picture(description.picture);
    if (shaders.empty()) return;
    document.scene()["extras"]["kinora_rsl"] = shaders;
    rsl.move_picture("/scenes/0/extras/kinora_rsl", description.picture);
    losses.in_extras("the scene", "its atmosphere and imagers");
}

void write_scene_extras(const SceneDescription& description, std::span<const Take> takes,
                        const CurveWriter& curves, GltfDocument& document, LossReport& losses) {
    Json extras = Json::object();
    Json ranges = clip_ranges(description, takes, curves);
    if (!ranges.empty()) extras["kinora_clips"] = ranges;
    if (description.start_time) extras["kinora_start_time"] = *description.start_time;
    if (description.end_time) extras["kinora_end_time"] = *description.end_time;
    if (description.frame_rate) extras["kinora_frame_rate"] = *description.frame_rate;
    if (!ranges.empty())
        losses.in_extras("the scene", fmt::format("the ranges of {} clips", ranges.size()));
    if (!extras.empty()) document.scene()["extras"].update(extras);
}

}  // namespace kinora
