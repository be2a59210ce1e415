// runtime/scene/gltf/curves/node_motion.cpp: stacks of transforms and weights as curves of glTF
// nodes.
#include "runtime/scene/gltf/curves/node_motion.h"

#include <algorithm>

#include "runtime/scene/description/morph_weights.h"
#include "runtime/scene/gltf/curves/trs.h"

namespace kinora {

NodeMotion::NodeMotion(const SceneDescription& description, std::span<const Take> takes,
                       CurveWriter& curves)
    : description_(description), takes_(takes), curves_(curves), values_(description) {}

bool NodeMotion::is_moved(std::span<const Transform> stack) const {
    return std::any_of(takes_.begin(), takes_.end(), [&](const Take& take) {
        return !channels_of(*take.animation, stack).empty();
    });
}

bool NodeMotion::is_always_trs(const dmat4& before, std::span<const Transform> stack) {
    Trs trs;
    bool holds = decompose_trs(stack_matrix(before, stack, values_.values()), trs);
    for (const Take& take : takes_) {
        std::vector<MovingChannel> moving = channels_of(*take.animation, stack);
        std::vector<double> times = key_times(stack, moving, description_);
        auto look = [&](double time) {
            values_.evaluate(moving, time);
            holds = holds && decompose_trs(stack_matrix(before, stack, values_.values()), trs);
        };
        for (size_t k = 0; k < times.size(); ++k) {
            look(times[k]);
            for (double s : kProbes)
                if (k + 1 < times.size()) look(times[k] + s * (times[k + 1] - times[k]));
        }
        values_.to_rest(moving);
    }
    return holds;
}

// Where the stack is translations and scales and turns each on its own, one transform's cubics
// are the path's: the one of the kind that moves, or null.
const Transform* NodeMotion::only_mover(uint32_t take, std::span<const Transform> stack,
                                        TransformKind kind) const {
    const Transform* only = nullptr;
    bool linear_before = true;
    for (const Transform& t : stack) {
        if (t.kind == TransformKind::Matrix || t.kind == TransformKind::Skew ||
            t.kind == TransformKind::Lookat)
            return nullptr;
        if (t.kind == kind) {
            bool moving = !channels_of(*takes_[take].animation, t.value, 16).empty();
            if ((only && moving) || !linear_before) return nullptr;
            if (moving) only = &t;
        }
        if (kind == TransformKind::Translate && t.kind != kind) linear_before = false;
        if (kind == TransformKind::Scale && t.kind == kind && only != &t) return nullptr;
    }
    return only;
}

void NodeMotion::move_node(uint32_t node, std::span<const Transform> stack, const dmat4& before) {
    for (uint32_t take = 0; take < takes_.size(); ++take) move_node(take, node, stack, before);
}

void NodeMotion::move_node(uint32_t take, uint32_t node, std::span<const Transform> stack,
                           const dmat4& before) {
    const anim::Animation& animation = *takes_[take].animation;
    std::vector<MovingChannel> channels = channels_of(animation, stack);
    if (channels.empty()) return;
    auto trs_at = [&](double time) {
        values_.evaluate(channels, time);
        Trs trs;
        decompose_trs(stack_matrix(before, stack, values_.values()), trs);
        return trs;
    };
    PropertyCurve curve;
    curve.channels = channels;
    curve.times = key_times(stack, channels, description_);
    auto triple = [](const dvec3& v, double* out) { out[0] = v.x, out[1] = v.y, out[2] = v.z; };
    curve.name = "translation";
    curve.width = 3;
    curve.at = [&](double t, double* out) { triple(trs_at(t).translation, out); };
    auto add = [&](TransformKind kind) {
        const Transform* t = before == dmat4(1.0) ? only_mover(take, stack, kind) : nullptr;
        if (t) {
            PropertyCurve own = curve;
            own.channels = channels_of(animation, t->value, 3);
            if (curves_.add_spline(take, node, own, t->value)) return;
        }
        curves_.add(take, node, curve);
    };
    add(TransformKind::Translate);
    curve.name = "scale";
    curve.at = [&](double t, double* out) { triple(trs_at(t).scale, out); };
    // A scale that mirrors is written as another scale with a turn: only sampled.
    bool mirrors = false;
    for (double t : curve.times) mirrors |= trs_at(t).scale.x < 0;
    if (mirrors)
        curves_.add(take, node, curve);
    else
        add(TransformKind::Scale);
    curve.name = "rotation";
    curve.width = 4;
    curve.rotation = true;
    curve.at = [&](double t, double* out) {
        std::array<double, 4> q = trs_at(t).rotation;
        std::copy(q.begin(), q.end(), out);
    };
    curves_.add(take, node, curve);
    values_.to_rest(channels);
}

// Of all morphs of a chain together, as glTF's targets are.
void NodeMotion::move_weights(uint32_t node, uint32_t morph) {
    const ValueSlot& weights = description_.morphs[morph].weights;
    const std::vector<uint32_t> chain = morph_chain(description_, morph);
    for (uint32_t take = 0; take < takes_.size(); ++take) {
        PropertyCurve curve;
        curve.name = "weights";
        curve.width = uint32_t(chain_targets(description_, morph));
        for (uint32_t m : chain) {
            const ValueSlot& own = description_.morphs[m].weights;
            for (MovingChannel& c : channels_of(*takes_[take].animation, own.offset, own.count))
                curve.channels.push_back(std::move(c));
        }
        if (curve.channels.empty()) continue;
        curve.times = key_times({}, curve.channels, description_);
        std::vector<MovingChannel> channels = curve.channels;
        curve.at = [&](double time, double* out) {
            values_.evaluate(channels, time);
            morph_weights(description_, values_.values(), morph, {out, curve.width});
        };
        if (chain.size() > 1 || !curves_.add_spline(take, node, curve, weights.offset))
            curves_.add(take, node, curve);
        values_.to_rest(channels);
    }
}

}  // namespace kinora
