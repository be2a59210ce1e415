// runtime/scene/dae/export_clips.cpp: curves of clips and of the scene as <animation>s and
// <animation_clip>s.
#include "runtime/scene/dae/export_clips_p.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "collada/document/edit.h"
#include "runtime/scene/dae/export_p.h"

namespace kinora {

namespace {

// <animation>s of the same key times: they share what is equal.
class AnimationGroup {
  public:
    AnimationGroup(std::string id, const Keys& keys) : id_(std::move(id)) {
        size_t count = keys.times.size();
        std::string kinds;
        for (const char* kind : keys.interpolations) kinds += fmt::format("{} ", kind);
        sources_ = float_source(id_ + "-input", number_text(keys.times), count, {"TIME"}) +
                   fmt::format(
                       "<source id=\"{0}-kinds\"><Name_array id=\"{0}-kinds-array\" "
                       "count=\"{1}\">{2}</Name_array><technique_common><accessor "
                       "source=\"#{0}-kinds-array\" count=\"{1}\" stride=\"1\"><param "
                       "name=\"INTERPOLATION\" type=\"name\"/></accessor></technique_common>"
                       "</source>",
                       id_, count, kinds);
    }

    void add(const Keys& keys, const std::string& target) {
        std::string own = fmt::format("{}-{}", id_, number_++);
        size_t count = keys.times.size();
        bool matrix = keys.stride == 16;
        std::vector<std::string> params{"VALUE"};
        if (keys.stride == 3) params = {"X", "Y", "Z"};
        if (keys.stride == 4) params = {"X", "Y", "Z", "ANGLE"};
        std::string inputs = input("INPUT", id_ + "-input");
        auto source = [&](const char* semantic, const char* name,
                          const std::vector<double>& numbers, const std::vector<std::string>& named,
                          const char* type) {
            sources_ += float_source(own + name, number_text(numbers), count, named, type);
            inputs += input(semantic, own + name);
        };
        source("OUTPUT", "", keys.values, params, matrix ? "float4x4" : "float");
        inputs += input("INTERPOLATION", id_ + "-kinds");
        if (keys.curved && !keys.in.empty()) {
            source("IN_TANGENT", "-in", keys.in, {"X", "Y"}, "float");
            source("OUT_TANGENT", "-out", keys.out, {"X", "Y"}, "float");
        }
        samplers_ += xml("sampler", attribute("id", own + "-sampler"), inputs);
        channels_ +=
            fmt::format("<channel source=\"#{}-sampler\"{}/>", own, attribute("target", target));
    }

    std::string text() const {
        return xml("animation", attribute("id", id_), sources_ + samplers_ + channels_);
    }

  private:
    std::string id_, sources_, samplers_, channels_;
    size_t number_ = 0;
};

template <class T>
void append_bytes(const std::vector<T>& numbers, std::string& key) {
    key.append(reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(T));
}

std::string kinds_of(const Keys& keys) {
    std::string kinds;
    for (const char* kind : keys.interpolations) kinds += fmt::format(" {}", kind);
    return kinds;
}

std::string key_of(const WrittenCurve& curve) {
    std::string key = curve.target + kinds_of(curve.keys) + '\n';
    for (const auto* numbers :
         {&curve.keys.times, &curve.keys.values, &curve.keys.in, &curve.keys.out})
        append_bytes(*numbers, key);
    return key;
}

// <animation>s, each with the clips that it plays in.
struct WrittenAnimation {
    std::string id;
    AnimationGroup group;
    std::set<uint32_t> clips;
    bool in_scene;
};

// Names of clips are any text; an attribute `name` of 1.4.1 is not.
std::string clip_text(const ClipDefinition& clip, const std::string& id,
                      const std::string& instances) {
    std::string name = xml_name(clip.name);
    std::string extra = name == clip.name
                            ? ""
                            : xml("extra", "",
                                  xml("technique", attribute("profile", "KINORA"),
                                      xml("name", "", collada::escape_text(clip.name))));
    return xml("animation_clip",
               attribute("id", id) + attribute("start", number_text(std::array{clip.start})) +
                   attribute("end", number_text(std::array{clip.end})) + attribute("name", name),
               instances + extra);
}

}  // namespace

void CurveList::add(WrittenCurve curve, uint32_t clip) {
    auto [at, fresh] = known_.try_emplace(key_of(curve), curves_.size());
    if (fresh) curves_.push_back(std::move(curve));
    WrittenCurve& known = curves_[at->second];
    if (clip == kNone)
        known.in_scene = true;
    else
        known.clips.insert(clip);
}

std::vector<uint32_t> CurveList::moved_by_clips_alone() const {
    std::set<uint32_t> moved, in_scene;
    for (const WrittenCurve& c : curves_)
        (c.in_scene ? in_scene : moved).insert(c.numbers.begin(), c.numbers.end());
    std::vector<uint32_t> alone;
    std::ranges::set_difference(moved, in_scene, std::back_inserter(alone));
    return alone;
}

uint32_t CurveList::clip_of_scene(const SceneDescription& description) const {
    for (uint32_t clip = 0; clip < description.clips.size(); ++clip)
        if (description.clips[clip].animation &&
            std::ranges::all_of(curves_, [&](const WrittenCurve& c) {
                return c.in_scene || !c.clips.contains(clip);
            }))
            return clip;
    return kNone;
}

bool CurveList::leaves(const anim::TimeRange& range) const {
    return std::ranges::any_of(curves_, [&](const WrittenCurve& c) {
        return c.keys.times.front() < range.begin || c.keys.times.back() > range.end;
    });
}

CurveList::Text CurveList::text(const SceneDescription& description, UniqueNames& names) const {
    std::vector<WrittenAnimation> animations;
    std::map<std::pair<std::string, std::set<uint32_t>>, size_t> by_times;
    for (bool in_scene : {false, true})
        for (const WrittenCurve& c : curves_) {
            if (c.in_scene != in_scene) continue;
            std::string times = number_text(c.keys.times) + kinds_of(c.keys);
            auto [at, fresh] = by_times.try_emplace({std::move(times), c.clips}, animations.size());
            if (fresh || animations[at->second].in_scene != in_scene) {
                std::string id = names.name("animation", "animation");
                at->second = animations.size();
                animations.push_back({id, AnimationGroup(id, c.keys), c.clips, in_scene});
            }
            animations[at->second].group.add(c.keys, c.target);
        }
    Text text;
    for (const WrittenAnimation& a : animations) text.animations += a.group.text();
    for (uint32_t k = 0; k < description.clips.size(); ++k) {
        const ClipDefinition& clip = description.clips[k];
        std::string instances;
        for (const WrittenAnimation& a : animations)
            if (clip.animation ? a.clips.contains(k) : a.in_scene)
                instances += xml("instance_animation", attribute("url", "#" + a.id), "");
        if (!instances.empty())  // the schema wants one
            text.clips += clip_text(clip, names.name(clip.name, "clip"), instances);
    }
    return text;
}

}  // namespace kinora
