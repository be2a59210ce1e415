// runtime/scene/gltf/import/animations.cpp: glTF's animations as channels; each is a clip.
#include "runtime/scene/gltf/import/animations.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/gltf/file/value.h"
#include "runtime/scene/gltf/pointers/channel_target.h"

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

constexpr uint32_t kPiecesOfFormula = 16;  // straight pieces between two keys

// HERMITE's tangents are derivatives over a segment's 0..1, CUBICSPLINE's over seconds (glTF 2.0,
// appendix C.5).
anim::Sampler make_sampler(const std::vector<double>& times, const std::vector<double>& output,
                           uint32_t stride, const InterpolationRow& row, bool rotation,
                           anim::SamplerRepairs& repairs) {
    size_t keys = std::min(times.size(), output.size() / (stride * row.parts));
    std::vector<double> values, in, out;
    for (size_t k = 0; k < keys; ++k) {
        const double* key = &output[k * stride * row.parts];
        const double* value = row.parts == 3 ? key + stride : key;
        values.insert(values.end(), value, value + stride);
        if (row.parts != 3) continue;
        double before = k > 0 ? times[k] - times[k - 1] : 0;
        double after = k + 1 < times.size() ? times[k + 1] - times[k] : 0;
        for (uint32_t c = 0; c < stride; ++c) {
            in.push_back(before * key[c]);
            out.push_back(after * key[2 * stride + c]);
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

// Lists that no type of an accessor holds are scalars one after the other.
bool is_list(uint32_t width) {
    return width > 4 && width != 16;
}

// All keys of some samplers; null ones have none.
std::vector<double> union_of_keys(std::span<const anim::Sampler* const> samplers) {
    std::vector<double> times;
    for (const anim::Sampler* s : samplers)
        if (s) times.insert(times.end(), s->times.begin(), s->times.end());
    std::ranges::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

bool is_all_steps(const anim::Sampler& s) {
    return std::ranges::all_of(
        s.interpolations, [](anim::Interpolation i) { return i == anim::Interpolation::Step; });
}

// What a formula makes of its values over time: straight pieces, or steps of steps.
anim::Sampler sampler_of_formula(const SlotFollower& follower,
                                 std::span<const anim::Sampler* const> samplers,
                                 std::span<const double> keys) {
    bool steps = std::ranges::all_of(samplers,
                                     [](const anim::Sampler* s) { return !s || is_all_steps(*s); });
    std::vector<double> times, numbers;
    std::vector<std::vector<double>> values;
    for (const FileValue& value : follower.values) values.push_back(value.rest);
    auto add = [&](double time) {
        for (size_t v = 0; v < samplers.size(); ++v)
            if (samplers[v]) anim::evaluate(*samplers[v], time, 0, values[v]);
        times.push_back(time);
        numbers.resize(numbers.size() + follower.width());
        follower.formula(values, &numbers[numbers.size() - follower.width()]);
    };
    for (size_t k = 0; k < keys.size(); ++k) {
        add(keys[k]);
        for (uint32_t i = 1; !steps && k + 1 < keys.size() && i < kPiecesOfFormula; ++i)
            add(keys[k] + (keys[k + 1] - keys[k]) * i / kPiecesOfFormula);
    }
    const anim::Interpolation kind =
        steps ? anim::Interpolation::Step : anim::Interpolation::Linear;
    anim::SamplerSource source;
    source.times = times;
    source.values = numbers;
    source.stride = follower.width();
    source.interpolations = std::span(&kind, 1);
    return anim::make_sampler(source);
}

}  // namespace

// What a channel of a node writes; no slot where that is nothing that is shown.
AnimationImporter::Written AnimationImporter::written_by(uint32_t node,
                                                         const std::string& path) const {
    const NodeSlots& slots = slots_[node];
    if (path == "translation") return {{slots.translation, 3}, node};
    if (path == "rotation") return {{slots.rotation, 4}, node};
    if (path == "scale") return {{slots.scale, 3}, node};
    if (path != "weights" || slots.morph == kNone) return {};
    return {out_.morphs[slots.morph].weights, uint32_t(out_.nodes.size()) + slots.morph};
}

std::optional<anim::Sampler> AnimationImporter::sampler_of(uint32_t animation, uint32_t channel,
                                                           const Output& output) {
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
    AccessorNumbers keys, numbers;
    if (!accessors_.read(sampler.input, keys) || !accessors_.read(sampler.output, numbers))
        return std::nullopt;
    if (keys.width != 1) return refuse("/input", "times are single numbers");
    if (uint32_t width = output.is_list ? 1 : output.width; numbers.width != width)
        return refuse("/output",
                      fmt::format("{} numbers an element, not {}", numbers.width, width));
    if (output.width == 0 || !budget_.charge(numbers.values.size() * 8 * row->parts, pointer))
        return std::nullopt;
    std::vector<double> times(keys.values.begin(), keys.values.end());
    std::vector<double> values(numbers.values.begin(), numbers.values.end());
    for (double& value : values) value *= output.scale;
    anim::SamplerRepairs repairs;
    anim::Sampler made =
        make_sampler(times, values, output.width, *row, output.is_rotation, repairs);
    if (std::string text = to_text(repairs); !text.empty())
        report_.add(Code::GLTF_ANIMATION, pointer, from.name, text);
    if (made.empty()) return std::nullopt;
    return made;
}

anim::Animation AnimationImporter::animation_of(uint32_t index) {
    const tinygltf::Animation& from = model_.animations[index];
    Made made;
    for (uint32_t c = 0; c < from.channels.size(); ++c) {
        ChannelTarget target = target_of(from.channels[c]);
        if (!target.pointer.empty())
            import_pointer(index, c, target.pointer, made);
        else if (has_index(target.node, model_.nodes.size()))
            import_node_channel(index, c, uint32_t(target.node), target.path, made);
        else if (from.channels[c].target_path == "pointer")
            report_.add(Code::GLTF_ANIMATION,
                        fmt::format("/animations/{}/channels/{}/target", index, c), from.name,
                        "its target has no pointer to a value of the file");
    }
    import_formulas(index, made);
    return anim::make_animation(std::move(made.samplers), std::move(made.channels));
}

void AnimationImporter::import_node_channel(uint32_t animation, uint32_t channel, uint32_t node,
                                            const std::string& path, Made& made) {
    Written target = written_by(node, path);
    if (!target.slot.present() || target.slot.count == 0) {
        if (tree_.shown[node])
            report_.add(Code::GLTF_ANIMATION,
                        fmt::format("/animations/{}/channels/{}/target", animation, channel),
                        model_.animations[animation].name,
                        fmt::format("node {} has no {} to write", node, path));
        return;
    }
    Output output{target.slot.count};
    output.is_rotation = path == "rotation";
    output.is_list = path == "weights";
    std::optional<anim::Sampler> sampler = sampler_of(animation, channel, output);
    if (!sampler) return;
    anim::Channel to;
    to.sampler = uint32_t(made.samplers.size());
    to.slot = target.slot.offset;
    to.count = target.slot.count;
    to.owner = target.owner;
    made.samplers.push_back(std::move(*sampler));
    made.channels.push_back(to);
}

void AnimationImporter::import_pointer(uint32_t animation, uint32_t channel,
                                       const std::string& pointer, Made& made) {
    std::span<const uint32_t> numbers = pointers_.followers_of(pointer);
    if (numbers.empty() && !pointers_.is_passed_over(pointer))
        report_.add(Code::GLTF_POINTER,
                    fmt::format("/animations/{}/channels/{}/target/extensions/"
                                "KHR_animation_pointer/pointer",
                                animation, channel),
                    model_.animations[animation].name, pointer);
    for (uint32_t number : numbers) {
        const SlotFollower& follower = pointers_.followers()[number];
        auto value = std::ranges::find(follower.values, pointer, &FileValue::pointer);
        uint32_t width = uint32_t(value->rest.size());
        std::optional<anim::Sampler> sampler =
            sampler_of(animation, channel, {width, follower.scale, false, is_list(width)});
        if (!sampler) return;
        if (!follower.formula) {
            add_followers(follower, std::move(*sampler), made);
            continue;
        }
        auto& samplers = made.formulas[number];
        samplers.resize(follower.values.size());
        made.values.push_back(std::move(*sampler));
        samplers[size_t(value - follower.values.begin())] = &made.values.back();
    }
}

void AnimationImporter::import_formulas(uint32_t animation, Made& made) {
    for (const auto& [number, samplers] : made.formulas) {
        const SlotFollower& follower = pointers_.followers()[number];
        std::vector<double> keys = union_of_keys(samplers);
        if (!budget_.charge(keys.size() * kPiecesOfFormula * (follower.width() + 1) * 8,
                            fmt::format("/animations/{}", animation)))
            return;
        add_followers(follower, sampler_of_formula(follower, samplers, keys), made);
    }
}

// A sampler of the numbers of all slots. Looks have one owner in common, behind the morphs.
void AnimationImporter::add_followers(const SlotFollower& follower, anim::Sampler sampler,
                                      Made& made) const {
    anim::Channel to;
    to.sampler = uint32_t(made.samplers.size());
    to.owner = uint32_t(out_.nodes.size() + out_.morphs.size());
    for (ValueSlot slot : follower.slots) {
        to.slot = slot.offset;
        to.count = slot.count;
        made.channels.push_back(to);
        to.component += slot.count;
    }
    made.samplers.push_back(std::move(sampler));
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
