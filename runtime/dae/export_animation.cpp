// runtime/dae/export_animation.cpp: channels and samplers, the same values at all times.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/dae/export_animation_p.h"
#include "runtime/dae/export_p.h"
#include "runtime/description/findings.h"
#include "runtime/scene/transforms.h"

namespace kinora {

namespace {

constexpr int kPiecesOfCurve = 16;   // of a curved rotation: straight pieces a segment
constexpr double kAxisError = 3e-7;  // of a unit axis; glTF's quaternions are floats
constexpr double kHalfTurn = 1e-12;  // |cos| of half the turn that counts as one (anim::slerp)

// The arrays of a <sampler>.
struct Keys {
    std::vector<double> times, values, in, out;  // tangents as (time, value) pairs
    std::vector<std::string> interpolations;
    size_t stride = 1;
    bool curved = false;

    void add(double time, const char* interpolation) {
        times.push_back(time);
        interpolations.push_back(interpolation);
    }
};

bool is_curve(anim::Interpolation i) {
    return i != anim::Interpolation::Step && i != anim::Interpolation::Linear;
}

const char* straight(anim::Interpolation i) {
    return i == anim::Interpolation::Step ? "STEP" : "LINEAR";
}

// One component: any cubic is a BEZIER with absolute control points.
Keys component_keys(const anim::Sampler& s, uint32_t component) {
    Keys keys;
    size_t count = s.times.size();
    for (size_t k = 0; k < count; ++k) {
        double value = s.values[k * s.stride + component];
        keys.add(s.times[k], straight(s.interpolations[k]));
        keys.values.push_back(value);
        keys.in.insert(keys.in.end(), {s.times[k], value});
        keys.out.insert(keys.out.end(), {s.times[k], value});
    }
    for (size_t k = 0; k + 1 < count; ++k) {
        if (!is_curve(s.interpolations[k])) continue;
        const anim::CurveSegment& c = s.curves[k * s.stride + component];
        keys.curved = true;
        keys.interpolations[k] = "BEZIER";
        keys.out[2 * k] = s.times[k] + c.time[0];
        keys.out[2 * k + 1] = c.value[1];
        keys.in[2 * k + 2] = s.times[k] + c.time[1];
        keys.in[2 * k + 3] = c.value[2];
    }
    return keys;
}

// Keys without curves, of several numbers each.
Keys whole_keys(const anim::Sampler& s, uint32_t component, uint32_t count) {
    Keys keys;
    keys.stride = count;
    for (size_t k = 0; k < s.times.size(); ++k) {
        keys.add(s.times[k], straight(s.interpolations[k]));
        auto first = s.values.begin() + std::ptrdiff_t(k * s.stride + component);
        keys.values.insert(keys.values.end(), first, first + count);
    }
    return keys;
}

// The times at which a rotation is written: curves in straight pieces.
template <class F>
Keys rotation_keys(const anim::Sampler& s, F&& add) {
    Keys keys;
    auto at = [&](double time, const char* interpolation) {
        double q[4];
        anim::evaluate(s, time, 0, q);
        keys.add(time, interpolation);
        add(keys.values, q);
    };
    for (size_t k = 0; k < s.times.size(); ++k) {
        at(s.times[k], straight(s.interpolations[k]));
        if (k + 1 == s.times.size() || !is_curve(s.interpolations[k])) continue;
        keys.curved = true;
        for (int i = 1; i < kPiecesOfCurve; ++i)
            at(s.times[k] + (s.times[k + 1] - s.times[k]) * i / kPiecesOfCurve, "LINEAR");
    }
    return keys;
}

// LINEAR matrices turn at constant speed, as slerp does.
Keys matrix_keys(const anim::Sampler& s) {
    Keys keys = rotation_keys(s, [](std::vector<double>& values, const double* q) {
        dmat4 m = transform_matrix(TransformKind::Quaternion, q);
        for (int r = 0; r < 4; ++r)
            for (int c = 0; c < 4; ++c) values.push_back(float(m[c][r]));  // as good as its source
    });
    keys.stride = 16;
    return keys;
}

// Angles on one axis, each from the one before by the way that slerp goes.
Keys angle_keys(const anim::Sampler& s, const dvec3& axis) {
    Keys keys = rotation_keys(s, [&](std::vector<double>& values, const double* q) {
        double angle = angle_about(axis, q);
        if (!values.empty()) {
            double turn = std::remainder(angle - values.back(), 360.0);
            if (std::abs(std::cos(radians(0.5 * turn))) <= kHalfTurn) turn = 180;
            angle = values.back() + turn;
        }
        values.push_back(angle);
    });
    for (double& angle : keys.values) angle = float(angle);
    return keys;
}

// <animation>s of the same key times: they share what is equal.
class AnimationGroup {
  public:
    AnimationGroup(std::string id, const Keys& keys) : id_(std::move(id)) {
        size_t count = keys.times.size();
        std::string kinds;
        for (const std::string& i : keys.interpolations) kinds += i + " ";
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

}  // namespace

double angle_about(const dvec3& axis, const double* q) {
    double along = q[0] * axis.x + q[1] * axis.y + q[2] * axis.z;
    return 2 * std::atan2(along, q[3]) * (180 / kPi);
}

std::string UniqueNames::name(const std::string& wanted, const char* kind) {
    std::string name = wanted.empty() ? kind : xml_name(wanted);
    std::string unique = name;
    for (int n = 2; !taken_.insert(unique).second; ++n) unique = fmt::format("{}_{}", name, n);
    return unique;
}

bool AnimationWriter::moves(ValueSlot slot) const {
    for (uint32_t k = 0; slot.present() && k < slot.count; ++k) {
        uint32_t number = slot.offset + k;
        if (number < description_.animated.size() && description_.animated[number]) return true;
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

const anim::Sampler* AnimationWriter::sampler_of(uint32_t quaternion) const {
    for (const anim::Channel& c : description_.animation.channels)
        if (c.slot == quaternion && c.count == 4)
            return &description_.animation.samplers[c.sampler];
    return nullptr;
}

std::optional<dvec3> AnimationWriter::hinge(uint32_t quaternion) const {
    std::vector<double> turns(&description_.values[quaternion],
                              &description_.values[quaternion] + 4);
    if (moves({quaternion, 4})) {
        const anim::Sampler* sampler = sampler_of(quaternion);
        if (!sampler || sampler->stride != 4) return std::nullopt;
        rotation_keys(*sampler,
                      [&](auto&, const double* q) { turns.insert(turns.end(), q, q + 4); });
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

std::string AnimationWriter::text(Diagnostics& diagnostics) {
    std::vector<AnimationGroup> groups;
    std::map<std::string, size_t> by_times;
    uint32_t sampled = 0;
    size_t unnamed = 0;
    const anim::Animation& animation = description_.animation;
    auto add = [&](const Keys& keys, const std::string& target) {
        std::string key = number_text(keys.times);
        for (const std::string& i : keys.interpolations) key += " " + i;
        auto [group, fresh] = by_times.try_emplace(std::move(key), groups.size());
        if (fresh) groups.emplace_back(names_.name("animation", "animation"), keys);
        groups[group->second].add(keys, target);
    };
    for (const anim::Channel& c : animation.channels) {
        const anim::Sampler& s = animation.samplers[c.sampler];
        auto first = targets_.find(c.slot);
        if (s.empty()) continue;
        if (first == targets_.end()) {
            ++unnamed;
            continue;
        }
        const Target& target = first->second;
        if (target.rotation) {
            Keys keys = target.hinge ? angle_keys(s, *target.hinge) : matrix_keys(s);
            sampled += keys.curved;
            add(keys, target.path + (target.hinge ? ".ANGLE" : ""));
            continue;
        }
        bool curved = std::any_of(s.interpolations.begin(), s.interpolations.end(), is_curve);
        bool whole = c.slot_step == 1 && target.first == c.slot && target.count == c.count &&
                     c.count > 1 && s.stride >= c.component + c.count;
        if (whole && !curved) {
            add(whole_keys(s, c.component, c.count), target.path);
            continue;
        }
        for (uint32_t i = 0; i < c.count; ++i) {
            auto one = targets_.find(c.slot + i * c.slot_step);
            if (one == targets_.end())
                ++unnamed;
            else
                add(component_keys(s, c.component + i), one->second.path + one->second.member);
        }
    }
    if (unnamed)
        diagnostics.report(Code::CONVERT_LOST, Location{}, "the animation",
                           fmt::format("{} animated parameters", unnamed));
    if (sampled)
        diagnostics.report(Code::CONVERT_SAMPLED, Location{}, sampled,
                           1.0 / (kPiecesOfCurve * kPiecesOfCurve));
    if (description_.clips.size() > 1)
        diagnostics.report(
            Code::CONVERT_LOST, Location{}, "the animation",
            fmt::format("{} clips that move different things", description_.clips.size()));
    std::string content;
    for (const AnimationGroup& group : groups) content += group.text();
    return content;
}

}  // namespace kinora
