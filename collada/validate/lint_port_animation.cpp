// collada/validate/lint_port_animation.cpp: motion that other importers bend. Each habit is
// reported where it first occurs, wide turns at each sampler.
#include <cmath>

#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

void check_curves(Lint& lint) {
    size_t curved = 0;
    const Sampler* first = nullptr;
    for (const Sampler& sampler : lint.scene.samplers)
        for (Interpolation i : sampler.interpolation) {
            if (i == Interpolation::Linear) continue;
            if (!first) first = &sampler;
            ++curved;
        }
    if (first) lint.diag.report(Code::PORT_BEZIER, first->where, curved);
}

// Said of the longest sampler alone: who takes milliseconds for seconds does so everywhere.
void check_length(Lint& lint) {
    constexpr double kLong = 600;  // seconds
    const Sampler* longest = nullptr;
    for (const Sampler& s : lint.scene.samplers)
        if (!s.times.empty() && s.times.back() > (longest ? longest->times.back() : kLong))
            longest = &s;
    if (longest) lint.diag.report(Code::ANIM_LONG, longest->where, longest->times.back());
}

void check_clips(Lint& lint) {
    if (!lint.scene.clips.empty())
        lint.diag.report(Code::PORT_CLIPS, lint.scene.clips.front().where, lint.scene.clips.size());
}

const Transform* transform_of(const Lint& lint, const Channel& channel) {
    if (channel.ref.kind != Owner::Transform) return nullptr;
    return &lint.scene.nodes[channel.ref.owner].transforms[channel.ref.slot];
}

void check_parts(Lint& lint) {
    for (const Channel& channel : lint.scene.channels) {
        const Transform* transform = transform_of(lint, channel);
        // The angle of a rotation is what every exporter animates.
        if (!transform || channel.ref.count == transform->slot.count ||
            transform->kind == TransformKind::Rotate)
            continue;
        lint.diag.report(Code::PORT_AXIS_CHANNEL, channel.where, channel.target);
        return;
    }
}

// Neighbouring keys of an angle that lie more than half a turn apart.
void check_turns(Lint& lint) {
    std::vector<bool> seen(lint.scene.samplers.size());
    for (const Channel& channel : lint.scene.channels) {
        const Transform* transform = transform_of(lint, channel);
        if (!transform || transform->kind != TransformKind::Rotate || seen[channel.sampler])
            continue;
        seen[channel.sampler] = true;
        uint32_t angle = 3 - channel.ref.first;
        if (channel.ref.first > 3 || angle >= channel.ref.count) continue;
        const Sampler& s = lint.scene.samplers[channel.sampler];
        for (size_t k = 1; k < s.times.size(); ++k) {
            double turn = s.values[k * s.stride + angle] - s.values[(k - 1) * s.stride + angle];
            if (!(std::abs(turn) > 180)) continue;
            lint.diag.report(Code::PORT_ROTATION, s.where, k - 1, k, std::abs(turn));
            break;
        }
    }
}

// One matrix, or [translate] rotate... [scale].
bool is_plain(const Node& node) {
    if (node.transforms.size() == 1) return node.transforms[0].kind != TransformKind::Skew;
    int stage = 0;
    for (const Transform& transform : node.transforms) {
        int at = transform.kind == TransformKind::Translate ? 0
                 : transform.kind == TransformKind::Rotate  ? 1
                 : transform.kind == TransformKind::Scale   ? 2
                                                            : -1;
        if (at < stage) return false;
        stage = at == 1 ? 1 : at + 1;
    }
    return true;
}

void check_stacks(Lint& lint) {
    for (const Channel& channel : lint.scene.channels) {
        if (channel.ref.kind != Owner::Transform) continue;
        const Node& node = lint.scene.nodes[channel.ref.owner];
        if (node.document != 0 || is_plain(node)) continue;
        lint.diag.report(Code::PORT_STACK, node.where, node.id);
        return;
    }
}

}  // namespace

void lint_port_animation(Lint& lint) {
    check_curves(lint);
    check_length(lint);
    check_clips(lint);
    check_parts(lint);
    check_turns(lint);
    check_stacks(lint);
}

}  // namespace kinora::collada
