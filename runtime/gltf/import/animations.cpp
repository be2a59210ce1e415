// runtime/gltf/import/animations.cpp: glTF's animations as channels; each is a clip.
#include "runtime/gltf/import/animations.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "runtime/description/findings.h"
#include "runtime/gltf/file/value.h"

namespace kinora {

namespace {

struct InterpolationRow {
    const char* name;
    anim::Interpolation interpolation;
    size_t parts;  // elements a key: in-tangent, value, out-tangent of CUBICSPLINE
};
constexpr InterpolationRow kInterpolations[] = {
    {"LINEAR", anim::Interpolation::Linear, 1},
    {"STEP", anim::Interpolation::Step, 1},
    {"CUBICSPLINE", anim::Interpolation::Hermite, 3},
};

// HERMITE's tangents are derivatives over a segment's 0..1, CUBICSPLINE's over seconds (glTF 2.0,
// appendix C.5).
anim::Sampler make_sampler(const std::vector<double>& times, const std::vector<float>& output,
                           uint32_t stride, const InterpolationRow& row, bool rotation,
                           anim::SamplerRepairs& repairs) {
    size_t keys = std::min(times.size(), output.size() / (stride * row.parts));
    std::vector<double> values, in, out;
    for (size_t k = 0; k < keys; ++k) {
        const float* key = &output[k * stride * row.parts];
        const float* value = row.parts == 3 ? key + stride : key;
        values.insert(values.end(), value, value + stride);
        if (row.parts != 3) continue;
        double before = k > 0 ? times[k] - times[k - 1] : 0;
        double after = k + 1 < times.size() ? times[k + 1] - times[k] : 0;
        for (uint32_t c = 0; c < stride; ++c) {
            in.push_back(before * double(key[c]));
            out.push_back(after * double(key[2 * stride + c]));
        }
    }
    anim::SamplerSource source;
    source.times = times;
    source.values = values;
    source.stride = source.in_stride = source.out_stride = stride;
    source.interpolations = std::span(&row.interpolation, 1);
    source.in_tangents = in;
    source.out_tangents = out;
    source.kind = rotation ? anim::SampleKind::Quaternion : anim::SampleKind::Numbers;
    return anim::make_sampler(source, &repairs);
}

}  // namespace

// What a channel writes; no numbers where that is nothing that is shown.
AnimationImporter::Written AnimationImporter::written_by(
    const tinygltf::AnimationChannel& channel) const {
    uint32_t node = uint32_t(channel.target_node);
    const NodeSlots& slots = slots_[node];
    if (channel.target_path == "translation") return {slots.translation, 3, node};
    if (channel.target_path == "rotation") return {slots.rotation, 4, node};
    if (channel.target_path == "scale") return {slots.scale, 3, node};
    if (channel.target_path != "weights" || slots.morph == kNone) return {};
    ValueSlot weights = out_.morphs[slots.morph].weights;
    return {weights.offset, weights.count, uint32_t(out_.nodes.size()) + slots.morph};
}

std::optional<anim::Sampler> AnimationImporter::sampler_of(uint32_t animation, uint32_t channel,
                                                           uint32_t stride) {
    const tinygltf::Animation& from = model_.animations[animation];
    int index = from.channels[channel].sampler;
    if (!has_index(index, from.samplers.size())) return std::nullopt;
    const tinygltf::AnimationSampler& sampler = from.samplers[size_t(index)];
    std::string pointer = fmt::format("/animations/{}/samplers/{}", animation, index);
    auto refuse = [&](const std::string& member, const std::string& why) {
        report_.add(Code::GLTF_ANIMATION, pointer + member, from.name, why);
        return std::nullopt;
    };
    auto row = std::find_if(std::begin(kInterpolations), std::end(kInterpolations),
                            [&](const auto& r) { return sampler.interpolation == r.name; });
    if (row == std::end(kInterpolations))
        return refuse("/interpolation",
                      fmt::format("'{}' is no interpolation", sampler.interpolation));
    AccessorNumbers input, output;
    if (!accessors_.read(sampler.input, input) || !accessors_.read(sampler.output, output))
        return std::nullopt;
    if (input.width != 1) return refuse("/input", "times are single numbers");
    bool rotation = from.channels[channel].target_path == "rotation";
    bool weights = from.channels[channel].target_path == "weights";
    if (output.width != (weights ? 1 : stride))
        return refuse("/output", fmt::format("{} numbers an element, not {}", output.width,
                                             weights ? 1 : stride));
    if (stride == 0 || !budget_.charge(output.values.size() * 8 * row->parts, pointer))
        return std::nullopt;
    std::vector<double> times(input.values.begin(), input.values.end());
    anim::SamplerRepairs repairs;
    anim::Sampler made = make_sampler(times, output.values, stride, *row, rotation, repairs);
    if (std::string text = to_text(repairs); !text.empty())
        report_.add(Code::GLTF_ANIMATION, pointer, from.name, text);
    if (made.empty()) return std::nullopt;
    return made;
}

anim::Animation AnimationImporter::animation_of(uint32_t index) {
    const tinygltf::Animation& from = model_.animations[index];
    std::vector<anim::Sampler> samplers;
    std::vector<anim::Channel> channels;
    for (uint32_t c = 0; c < from.channels.size(); ++c) {
        const tinygltf::AnimationChannel& channel = from.channels[c];
        std::string pointer = fmt::format("/animations/{}/channels/{}/target", index, c);
        // None: an extension's target.
        if (!has_index(channel.target_node, model_.nodes.size())) continue;
        Written target = written_by(channel);
        if (target.slot == kNone || target.count == 0) {
            if (tree_.shown[size_t(channel.target_node)])
                report_.add(Code::GLTF_ANIMATION, pointer, from.name,
                            fmt::format("node {} has no {} to write", channel.target_node,
                                        channel.target_path));
            continue;
        }
        std::optional<anim::Sampler> sampler = sampler_of(index, c, target.count);
        if (!sampler) continue;
        anim::Channel made;
        made.sampler = uint32_t(samplers.size());
        made.slot = target.slot;
        made.count = target.count;
        made.owner = target.owner;
        samplers.push_back(std::move(*sampler));
        channels.push_back(made);
    }
    return anim::make_animation(std::move(samplers), std::move(channels));
}

// Animations play together, those that meet an earlier one by their clip alone.
void AnimationImporter::import_animations(UniqueIds& ids) {
    clip_of_.assign(model_.animations.size(), kNone);
    std::vector<anim::Sampler> samplers;
    std::vector<anim::Channel> channels;
    std::set<uint32_t> driven;
    bool has_whole = false;
    for (uint32_t a = 0; a < model_.animations.size(); ++a) {
        auto own = std::make_shared<anim::Animation>(animation_of(a));
        if (own->channels.empty()) continue;
        bool is_whole = member(model_.animations[a].extras, "kinora_whole") != nullptr;
        if (is_whole && driven.empty()) {
            has_whole = true;  // as kinora-convert writes it: what plays where no clip is chosen
            samplers = own->samplers;
            channels = own->channels;
            continue;
        }
        add_clip(a, own, ids);
        if (has_whole) continue;
        bool meets = std::any_of(own->channels.begin(), own->channels.end(),
                                 [&](const anim::Channel& c) { return driven.contains(c.slot); });
        if (meets) {
            const std::string& name = out_.clips.back().name;
            report_.add(Code::GLTF_ANIMATIONS_MEET, fmt::format("/animations/{}", a), name, name);
            continue;
        }
        for (anim::Channel channel : own->channels) {
            driven.insert(channel.slot);
            channel.sampler += uint32_t(samplers.size());
            channels.push_back(channel);
        }
        samplers.insert(samplers.end(), own->samplers.begin(), own->samplers.end());
    }
    out_.animation = anim::make_animation(std::move(samplers), std::move(channels));
    out_.animated.assign(out_.values.size(), false);
    for (const anim::Animation::Write& write : out_.animation.writes)
        out_.animated[write.slot] = true;
}

void AnimationImporter::add_clip(uint32_t animation, std::shared_ptr<const anim::Animation> own,
                                 UniqueIds& ids) {
    ClipDefinition clip;
    clip.id = clip.name = ids.id(model_.animations[animation].name, "animation", animation);
    anim::TimeRange range = anim::time_range(*own);
    clip.start = range.begin;
    clip.end = range.end;
    clip.animation = std::move(own);
    clip_of_[animation] = uint32_t(out_.clips.size());
    out_.clips.push_back(std::move(clip));
}

}  // namespace kinora
