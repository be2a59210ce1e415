// runtime/scene/dae/export_animation.cpp: channels and samplers, the same values at all times.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/curves/reduce_keys.h"
#include "runtime/scene/dae/export_animation_p.h"
#include "runtime/scene/dae/export_p.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/description/play_range.h"

namespace kinora {

namespace {

constexpr double kAxisError = 3e-7;  // of a unit axis; glTF's quaternions are floats
constexpr double kMadeError = 1e-4;  // of made numbers, of the range that they move over

// Keys of all channels, and whether they are steps alone.
std::vector<double> keys_of(const std::vector<MovingChannel>& channels, bool& steps) {
    std::vector<double> times;
    steps = true;
    for (const MovingChannel& c : channels) {
        times.insert(times.end(), c.sampler->times.begin(), c.sampler->times.end());
        for (size_t k = 0; k + 1 < c.sampler->times.size(); ++k)
            steps &= c.sampler->interpolations[k] == anim::Interpolation::Step;
    }
    std::ranges::sort(times);
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

// What has a number, for findings: "material 'brass'" and the name of its parameter; none where
// nothing has.
std::pair<std::string, std::string> owner_of(const SceneDescription& d, uint32_t number) {
    auto among = [&](const std::vector<ShaderUse>& uses) -> const ParamSource* {
        for (const ShaderUse& use : uses)
            for (const ParamSource& p : use.params)
                if (p.value.present() && number - p.value.offset < p.value.count) return &p;
        return nullptr;
    };
    for (const MaterialDefinition& m : d.materials)
        for (const auto* uses : {&m.transformations, &m.displacements, &m.surfaces, &m.interior,
                                 &m.exterior, &m.lights})
            if (const ParamSource* p = among(*uses))
                return {fmt::format("material '{}'", m.id), p->name};
    for (const LightDefinition& l : d.lights)
        if (const ParamSource* p = among({l.shader}))
            return {fmt::format("light '{}'", l.id), p->name};
    return {};
}

}  // namespace

std::string UniqueNames::name(const std::string& wanted, const char* kind) {
    std::string name = wanted.empty() ? kind : xml_name(wanted);
    std::string unique = name;
    for (int n = 2; !taken_.insert(unique).second; ++n) unique = fmt::format("{}_{}", name, n);
    return unique;
}

AnimationWriter::AnimationWriter(const SceneDescription& description, UniqueNames& names)
    : description_(description),
      names_(names),
      animated_(description.animated),
      values_(description) {
    animated_.resize(description.values.size(), false);
    for (const ClipDefinition& clip : description.clips)
        if (clip.animation)
            for (const anim::Animation::Write& write : clip.animation->writes)
                animated_[write.slot] = true;
}

bool AnimationWriter::moves(ValueSlot slot) const {
    for (uint32_t k = 0; slot.present() && k < slot.count; ++k) {
        uint32_t number = slot.offset + k;
        if (number < animated_.size() && animated_[number]) return true;
    }
    return false;
}

void AnimationWriter::name(ValueSlot slot, const std::string& target, const char* const* members) {
    for (uint32_t i = 0; slot.present() && i < slot.count; ++i) {
        Target& t = targets_[slot.offset + i];
        t = Target();
        t.path = target;
        t.first = slot.offset;
        t.count = slot.count == 16 || members ? slot.count : 1;
        if (slot.count == 16)
            t.member = fmt::format("({})({})", i % 4, i / 4);
        else if (members)
            t.member = members[i];
        else if (slot.count != 1)
            t.member = fmt::format("({})", i);
    }
}

// Calls f(animation, clip) for each clip's animation, and for the scene's own, whose clip is kNone.
template <class F>
void AnimationWriter::for_each_animation(F&& f) const {
    for (uint32_t k = 0; k < description_.clips.size(); ++k)
        if (const auto& own = description_.clips[k].animation) f(*own, k);
    f(description_.animation, kNone);
}

bool AnimationWriter::is_changed_by(const anim::Animation& animation, ValueSlot slot,
                                    const NumbersAt& numbers) {
    std::vector<MovingChannel> channels = channels_of(description_, animation, {&slot, 1});
    bool steps, changes = false;
    const std::vector<double> rest = numbers(description_.values);
    for (double time : keys_of(channels, steps)) {
        values_.evaluate(channels, time);
        changes |= numbers(values_.values()) != rest;
    }
    values_.to_rest(channels);
    return changes;
}

Keys AnimationWriter::made_keys(const std::vector<MovingChannel>& channels,
                                const NumbersAt& numbers) {
    Curve curve;
    curve.width = uint32_t(numbers(description_.values).size());
    curve.at = [&](double time, double* out) {
        values_.evaluate(channels, time);
        std::ranges::copy(numbers(values_.values()), out);
    };
    bool steps;
    const std::vector<double> times = keys_of(channels, steps);
    StraightKeys made;
    double moves = 0;
    for (double time : times) {
        std::vector<double>& all = made.numbers;
        all.resize(all.size() + curve.width);
        curve.at(time, &all[all.size() - curve.width]);
        moves = std::max(moves, curve.distance(all.data(), &all[all.size() - curve.width]));
    }
    made.times = times;
    if (!steps) made = reduce_keys(curve, times, kMadeError * moves);
    values_.to_rest(channels);
    Keys keys;
    keys.stride = curve.width;
    keys.values = std::move(made.numbers);
    for (double time : made.times) keys.add(time, steps ? "STEP" : "LINEAR");
    return keys;
}

// A curve for each number that is another one at some key.
void AnimationWriter::add_made(const std::string& target, const Keys& keys,
                               const std::vector<double>& rest, uint32_t first, uint32_t clip) {
    for (uint32_t i = 0; i < keys.stride; ++i) {
        Keys own;
        bool changes = false;
        own.times = keys.times;
        own.interpolations = keys.interpolations;
        for (size_t k = 0; k < keys.times.size(); ++k) {
            own.values.push_back(keys.values[k * keys.stride + i]);
            changes |= own.values.back() != rest[i];
        }
        if (changes)
            curves_.add({target + made_[first + i].member,
                         std::move(own),
                         {uint32_t(description_.values.size()) + first + i},
                         {}},
                        clip);
    }
}

bool AnimationWriter::name_made(const std::string& target, std::span<const ValueSlot> slots,
                                const NumbersAt& numbers) {
    const std::vector<double> rest = numbers(description_.values);
    const uint32_t first = uint32_t(made_.size());
    bool changes = false;
    for_each_animation([&](const anim::Animation& animation, uint32_t clip) {
        std::vector<ValueSlot> moving;
        for (ValueSlot slot : slots)
            if (is_changed_by(animation, slot, numbers)) moving.push_back(slot);
        if (moving.empty()) return;
        for (size_t i = 0; !changes && i < rest.size(); ++i) {
            Target& made = made_.emplace_back();
            made.path = target;
            if (rest.size() > 1) made.member = fmt::format("({})", i);
            made_rest_.push_back(rest[i]);
        }
        changes = true;
        for (ValueSlot slot : moving)
            for (uint32_t i = 0; i < slot.count; ++i)
                made_of_.insert(written_slot(description_, slot).offset + i);
        std::vector<MovingChannel> channels = channels_of(description_, animation, moving);
        add_made(target, made_keys(channels, numbers), rest, first, clip);
    });
    return changes;
}

// Of the scene and of all clips.
std::vector<const anim::Sampler*> AnimationWriter::samplers_of(uint32_t quaternion) const {
    std::vector<const anim::Sampler*> samplers;
    auto look = [&](const anim::Animation& animation) {
        for (const anim::Channel& c : animation.channels)
            if (c.slot == quaternion && c.count == 4)
                samplers.push_back(&animation.samplers[c.sampler]);
    };
    look(description_.animation);
    for (const ClipDefinition& clip : description_.clips)
        if (clip.animation) look(*clip.animation);
    return samplers;
}

std::optional<dvec3> AnimationWriter::hinge(uint32_t quaternion) const {
    std::vector<double> turns(&description_.values[quaternion],
                              &description_.values[quaternion] + 4);
    if (moves({quaternion, 4})) {
        std::vector<const anim::Sampler*> samplers = samplers_of(quaternion);
        if (samplers.empty()) return std::nullopt;
        for (const anim::Sampler* sampler : samplers) {
            if (sampler->stride != 4) return std::nullopt;
            std::vector<double> own = written_rotations(*sampler);
            turns.insert(turns.end(), own.begin(), own.end());
        }
    }
    dvec3 axis(0);  // of the widest turn: the rest is then no worse
    std::vector<dvec3> axes;
    for (size_t k = 0; k < turns.size(); k += 4) {
        dvec4 q(turns[k], turns[k + 1], turns[k + 2], turns[k + 3]);
        double length = glm::length(q);
        axes.push_back(length > 0 ? dvec3(q) / length : dvec3(0));
        if (glm::length(axes.back()) > glm::length(axis)) axis = axes.back();
    }
    if (glm::length(axis) == 0) return dvec3(1, 0, 0);
    axis = glm::normalize(axis);
    for (const dvec3& other : axes)
        if (glm::length(glm::cross(axis, other)) > kAxisError) return std::nullopt;
    for (int k = 0; k < 3; ++k) {
        if (std::abs(axis[k]) <= 1e-9) continue;
        return axis[k] < 0 ? -axis : axis;  // half turns are positive then (anim::slerp)
    }
    return axis;
}

void AnimationWriter::name_rotation(uint32_t quaternion, const std::string& target,
                                    std::optional<dvec3> axis) {
    targets_[quaternion] = {target, "", quaternion, 4, true, axis};
}

// Whether a key of the channel is not what stands there at rest.
bool AnimationWriter::leaves_rest(const anim::Sampler& s, const anim::Channel& c) const {
    for (size_t k = 0; k < s.times.size(); ++k)
        for (uint32_t i = 0; i < c.count; ++i)
            if (s.values[k * s.stride + c.component + i] !=
                description_.values[c.slot + i * c.slot_step])
                return true;
    return false;
}

// Calls add(WrittenCurve) for all that a channel writes.
template <class F>
void AnimationWriter::for_each_curve(const anim::Animation& animation, F&& add) {
    for (const anim::Channel& c : animation.channels) {
        const anim::Sampler& s = animation.samplers[c.sampler];
        auto first = targets_.find(c.slot);
        if (s.empty()) continue;
        if (first == targets_.end()) {
            if (!made_of_.contains(c.slot) && leaves_rest(s, c)) unnamed_.insert(c.slot);
            continue;
        }
        const Target& target = first->second;
        std::vector<uint32_t> numbers;
        for (uint32_t i = 0; i < c.count; ++i) numbers.push_back(c.slot + i * c.slot_step);
        if (target.rotation) {
            Keys keys = target.hinge ? angle_keys(s, *target.hinge) : matrix_keys(s);
            if (keys.curved) sampled_.insert(c.slot);
            add({target.path + (target.hinge ? ".ANGLE" : ""), std::move(keys), numbers, {}});
            continue;
        }
        bool curved = std::any_of(s.interpolations.begin(), s.interpolations.end(), is_curve);
        bool whole = c.slot_step == 1 && target.first == c.slot && target.count == c.count &&
                     c.count > 1 && s.stride >= c.component + c.count;
        if (whole && !curved) {
            add({target.path, whole_keys(s, c.component, c.count), numbers, {}});
            continue;
        }
        for (uint32_t i = 0; i < c.count; ++i) {
            auto one = targets_.find(numbers[i]);
            if (one == targets_.end() && !made_of_.contains(numbers[i]) && leaves_rest(s, c))
                unnamed_.insert(numbers[i]);
            if (one != targets_.end())
                add({one->second.path + one->second.member,
                     component_keys(s, c.component + i),
                     {numbers[i]},
                     {}});
        }
    }
}

// What a clip moves and the scene does not stands still without the clip: where all animations
// play, one key with the rest value has the last word.
void AnimationWriter::hold_still(Diagnostics& diagnostics) {
    std::vector<uint32_t> alone = curves_.moved_by_clips_alone();
    uint32_t clip = curves_.clip_of_scene(description_);
    if (alone.empty()) return;
    if (clip == kNone) {
        diagnostics.report(Code::CONVERT_LOST, Location{}, "the animation",
                           fmt::format("that {} numbers move in clips alone", alone.size()));
        return;
    }
    double begin = anim::time_range(description_.animation).begin;
    for (uint32_t number : alone) {
        if (number >= description_.values.size()) {
            const uint32_t own = number - uint32_t(description_.values.size());
            WrittenCurve still{made_[own].path + made_[own].member, {}, {number}, {}};
            still.keys.add(begin, "STEP");
            still.keys.values.push_back(made_rest_[own]);
            curves_.add(still, clip);
            curves_.add(std::move(still), kNone);
            continue;
        }
        auto found = targets_.find(number);
        if (found == targets_.end()) continue;  // the x of a quaternion stands for all of it
        const Target& target = found->second;
        const double* rest = &description_.values[number];
        WrittenCurve still{target.path + target.member, {}, {number}, {}};
        still.keys.add(begin, "STEP");
        if (target.hinge) {
            still.target += ".ANGLE";
            still.keys.values.push_back(angle_about(*target.hinge, rest));
        } else if (target.rotation) {
            still.keys.stride = 16;
            add_matrix(rest, still.keys.values);
        } else {
            still.keys.values.push_back(*rest);
        }
        curves_.add(still, clip);
        curves_.add(std::move(still), kNone);
    }
}

CurveList::Text AnimationWriter::text(Diagnostics& diagnostics) {
    for_each_animation([&](const anim::Animation& animation, uint32_t clip) {
        for_each_curve(animation, [&](WrittenCurve curve) { curves_.add(std::move(curve), clip); });
    });
    hold_still(diagnostics);
    report_unnamed(diagnostics);
    if (!sampled_.empty())
        diagnostics.report(Code::CONVERT_SAMPLED, Location{}, sampled_.size(),
                           1.0 / (kPiecesOfCurve * kPiecesOfCurve));
    return curves_.text(description_, names_);
}

// A number that nothing has is none that is shown.
void AnimationWriter::report_unnamed(Diagnostics& diagnostics) const {
    std::set<std::pair<std::string, std::string>> lost;
    for (uint32_t number : unnamed_) lost.insert(owner_of(description_, number));
    for (const auto& [owner, name] : lost)
        if (!owner.empty())
            diagnostics.report(Code::CONVERT_LOST, Location{}, owner,
                               fmt::format("its animated '{}'", name));
}

// The range that is played, where a reader would not find it in the keys.
std::string AnimationWriter::played_range() const {
    const SceneDescription& d = description_;
    bool is_given = d.start_time || d.end_time;
    std::string numbers;
    auto add = [&](const char* name, double value) {
        numbers += xml(name, "", number_text(std::span<const double>(&value, 1)));
    };
    PlayRange range = play_range(d);
    if (is_given || curves_.leaves(anim::time_range(d.animation))) {
        add("start_time", range.start);
        add("end_time", range.end);
    }
    if (d.frame_rate) add("frame_rate", *d.frame_rate);
    return numbers.empty()
               ? ""
               : xml("extra", "", xml("technique", attribute("profile", "FCOLLADA"), numbers));
}

}  // namespace kinora
