// runtime/dae/export_animation.cpp: channels and samplers, the same values at all times.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "runtime/dae/export_p.h"
#include "runtime/description/findings.h"
#include "runtime/scene/transforms.h"

namespace kinora {

namespace {

constexpr int kPiecesOfCurve = 16;  // of a curved rotation: straight pieces a segment

// The arrays of a <sampler>.
struct Keys {
    std::vector<double> times, values, in, out;  // tangents as (time, value) pairs
    std::vector<std::string> interpolations;
    size_t stride = 1;
    bool curved = false;
};

bool is_curve(anim::Interpolation i) {
    return i != anim::Interpolation::Step && i != anim::Interpolation::Linear;
}

// One component: any cubic is a BEZIER with absolute control points.
Keys component_keys(const anim::Sampler& s, uint32_t component) {
    Keys keys;
    keys.times = s.times;
    size_t count = s.times.size();
    for (size_t k = 0; k < count; ++k) {
        double value = s.values[k * s.stride + component];
        keys.values.push_back(value);
        keys.in.insert(keys.in.end(), {s.times[k], value});
        keys.out.insert(keys.out.end(), {s.times[k], value});
        keys.interpolations.push_back(s.interpolations[k] == anim::Interpolation::Step ? "STEP"
                                                                                       : "LINEAR");
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

void add_matrix(Keys& keys, double time, const dmat4& m, const char* interpolation) {
    keys.times.push_back(time);
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c) keys.values.push_back(float(m[c][r]));  // as good as its source
    keys.interpolations.push_back(interpolation);
}

// A rotation as matrices: LINEAR ones turn at constant speed, as slerp does.
Keys rotation_keys(const anim::Sampler& s, TransformKind kind) {
    Keys keys;
    keys.stride = 16;
    auto at = [&](double time) {
        double q[4];
        anim::evaluate(s, time, 0, q);
        return transform_matrix(kind, q);
    };
    for (size_t k = 0; k < s.times.size(); ++k) {
        bool step = s.interpolations[k] == anim::Interpolation::Step;
        add_matrix(keys, s.times[k], at(s.times[k]), step ? "STEP" : "LINEAR");
        if (k + 1 == s.times.size() || !is_curve(s.interpolations[k])) continue;
        keys.curved = true;
        for (int i = 1; i < kPiecesOfCurve; ++i) {
            double time = s.times[k] + (s.times[k + 1] - s.times[k]) * i / kPiecesOfCurve;
            add_matrix(keys, time, at(time), "LINEAR");
        }
    }
    return keys;
}

// <source>s and <sampler>.
std::string sampler_text(const std::string& id, const Keys& keys) {
    size_t count = keys.times.size();
    bool matrix = keys.stride == 16;
    std::string names;
    for (const std::string& i : keys.interpolations) names += i + " ";
    std::string text =
        float_source(id + "-input", number_text(keys.times), count, {"TIME"}) +
        float_source(id + "-output", number_text(keys.values), count, {"VALUE"},
                     matrix ? "float4x4" : "float") +
        fmt::format(
            "<source id=\"{0}-kinds\"><Name_array id=\"{0}-kinds-array\" count=\"{1}\">{2}"
            "</Name_array><technique_common><accessor source=\"#{0}-kinds-array\" "
            "count=\"{1}\" stride=\"1\"><param name=\"INTERPOLATION\" type=\"name\"/>"
            "</accessor></technique_common></source>",
            id, count, names);
    std::string inputs = fmt::format(
        "<input semantic=\"INPUT\" source=\"#{0}-input\"/><input semantic=\"OUTPUT\" "
        "source=\"#{0}-output\"/><input semantic=\"INTERPOLATION\" source=\"#{0}-kinds\"/>",
        id);
    if (keys.curved && !matrix) {
        text += float_source(id + "-in", number_text(keys.in), count, {"X", "Y"}) +
                float_source(id + "-out", number_text(keys.out), count, {"X", "Y"});
        inputs += fmt::format(
            "<input semantic=\"IN_TANGENT\" source=\"#{0}-in\"/><input "
            "semantic=\"OUT_TANGENT\" source=\"#{0}-out\"/>",
            id);
    }
    return text + xml("sampler", attribute("id", id + "-sampler"), inputs);
}

}  // namespace

// Says how a channel names these numbers.
void ColladaExporter::address(ValueSlot slot, const std::string& target,
                              const char* const* members) {
    for (uint32_t i = 0; i < slot.count; ++i) {
        Target& t = targets_[slot.offset + i];
        t.path = target;
        if (slot.count == 16) t.matrix = true;
        if (slot.count == 16) t.path += fmt::format("({})({})", i % 4, i / 4);
        if (slot.count != 16 && members) t.path += members[i];
        if (slot.count != 16 && slot.count != 1 && !members) t.path += fmt::format("({})", i);
    }
}

std::string ColladaExporter::animations() {
    std::string content;
    uint32_t sampled = 0;
    size_t unnamed = 0;
    const anim::Animation& animation = description_.animation;
    auto add = [&](const Keys& keys, const std::string& target) {
        std::string own = id("animation", "animation");
        content += xml("animation", attribute("id", own),
                       sampler_text(own, keys) + fmt::format("<channel source=\"#{}-sampler\"{}/>",
                                                             own, attribute("target", target)));
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
        if (target.quaternion == 0 && c.count == 4) {
            Keys keys = rotation_keys(s, TransformKind::Quaternion);
            sampled += keys.curved;
            add(keys, target.path);
            continue;
        }
        if (target.matrix && s.kind == anim::SampleKind::Matrix) {
            Keys keys;
            keys.stride = 16;
            keys.times = s.times;
            keys.values = s.values;
            for (anim::Interpolation i : s.interpolations)
                keys.interpolations.push_back(i == anim::Interpolation::Step ? "STEP" : "LINEAR");
            add(keys, target.path.substr(0, target.path.find('(')));
            continue;
        }
        for (uint32_t i = 0; i < c.count; ++i) {
            auto one = targets_.find(c.slot + i * c.slot_step);
            if (one == targets_.end())
                ++unnamed;
            else
                add(component_keys(s, c.component + i), one->second.path);
        }
    }
    if (unnamed) lost("the animation", fmt::format("{} animated parameters", unnamed));
    if (sampled)
        diagnostics_.report(Code::CONVERT_SAMPLED, Location{}, sampled,
                            1.0 / (kPiecesOfCurve * kPiecesOfCurve));
    std::string text = library("animations", content);
    if (description_.clips.size() > 1)
        lost("the animation",
             fmt::format("{} clips that move different things", description_.clips.size()));
    return text;
}

}  // namespace kinora
