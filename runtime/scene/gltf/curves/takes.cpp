// runtime/scene/gltf/curves/takes.cpp: what becomes an animation of glTF.
#include "runtime/scene/gltf/curves/takes.h"

#include <algorithm>
#include <map>
#include <set>

namespace kinora {

namespace {

// A curve as it drives one number.
struct Driver {
    const anim::Sampler* sampler;
    uint32_t component;
};
using Drivers = std::map<uint32_t, Driver>;  // by the number

bool is_same(const Driver& a, const Driver& b) {
    auto equal_curves = [](const anim::CurveSegment& x, const anim::CurveSegment& y) {
        return std::ranges::equal(x.value, y.value) && std::ranges::equal(x.time, y.time);
    };
    const anim::Sampler &s = *a.sampler, &t = *b.sampler;
    return a.component == b.component && s.times == t.times && s.values == t.values &&
           s.interpolations == t.interpolations && s.pre == t.pre && s.post == t.post &&
           std::ranges::equal(s.curves, t.curves, equal_curves);
}

void add_drivers(const anim::Animation& animation, Drivers& drivers) {
    for (size_t c = 0; c < animation.channels.size(); ++c)
        for (uint32_t w = animation.first_write[c]; w < animation.first_write[c + 1]; ++w)
            drivers[animation.writes[w].slot] = {&animation.samplers[animation.channels[c].sampler],
                                                 animation.writes[w].component};
}

// glTF's own stacks are a translation, a rotation and a scale, and each is a property of the node.
// Of others the curves of a node meet whatever they drive.
bool is_gltf_stack(const NodeDefinition& node) {
    auto rank = [](TransformKind kind) {
        return kind == TransformKind::Translate    ? 0
               : kind == TransformKind::Quaternion ? 1
               : kind == TransformKind::Scale      ? 2
                                                   : -1;
    };
    int last = -1;
    for (const Transform& t : node.transforms) {
        if (rank(t.kind) <= last) return false;
        last = rank(t.kind);
    }
    return true;
}

// What two takes must not both drive.
std::set<uint64_t> properties_of(const SceneDescription& description,
                                 const anim::Animation& animation) {
    std::set<uint64_t> properties;
    for (const anim::Channel& c : animation.channels) {
        bool is_property =
            c.owner < description.nodes.size() && is_gltf_stack(description.nodes[c.owner]);
        properties.insert(is_property ? uint64_t(c.slot) : (uint64_t(c.owner) + 1) << 32);
    }
    return properties;
}

// Whether a reader of the takes plays the scene's animation where no clip is chosen.
bool play_the_scene(const SceneDescription& description, const std::vector<Take>& takes) {
    std::set<uint64_t> driven;
    Drivers together, wanted;
    double begin = 1e300, end = -1e300;
    for (const Take& take : takes) {
        std::set<uint64_t> own = properties_of(description, *take.animation);
        if (std::ranges::any_of(own, [&](uint64_t p) { return driven.contains(p); })) continue;
        driven.insert(own.begin(), own.end());
        add_drivers(*take.animation, together);
        anim::TimeRange range = anim::time_range(*take.animation);
        begin = std::min(begin, range.begin);
        end = std::max(end, range.end);
    }
    add_drivers(description.animation, wanted);
    anim::TimeRange range = anim::time_range(description.animation);
    return begin == range.begin && end == range.end &&
           std::ranges::equal(together, wanted, [](const auto& a, const auto& b) {
               return a.first == b.first && is_same(a.second, b.second);
           });
}

}  // namespace

std::vector<Take> find_takes(const SceneDescription& description) {
    std::vector<Take> takes;
    for (const ClipDefinition& clip : description.clips)
        if (clip.animation) takes.push_back({clip.name, clip.animation.get()});
    if (takes.empty()) return {{"", &description.animation}};
    if (play_the_scene(description, takes)) return takes;
    // Where channels of COLLADA meet, the last one plays (anim/animation.h).
    std::ranges::reverse(takes);
    if (play_the_scene(description, takes)) return takes;
    std::ranges::reverse(takes);
    takes.insert(takes.begin(), {"all", &description.animation, true});
    return takes;
}

}  // namespace kinora
