// runtime/gltf/export/animation.cpp: curves as glTF's: exact where it has them, else sampled.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "anim/decompose.h"
#include "runtime/description/findings.h"
#include "runtime/description/play_range.h"
#include "runtime/gltf/export/export_p.h"
#include "runtime/scene/transforms.h"

namespace kinora {

namespace {

constexpr double kLargestTurn = 90;  // degrees between keys: slerp takes the shorter way
// The times as the file holds them, each later than the one before.
std::vector<double> distinct(std::vector<double> times) {
    for (double& t : times) t = double(float(t));
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    return times;
}

}  // namespace

// Clips stay apart where each plays all of an animation of its own and import_gltf, which plays
// together those that do not meet, makes the scene's animation of them again (glTF's own do). Other
// clips (COLLADA's, of parts of the scene's animation) are ranges of it.
void GltfExport::find_takes() {
    std::set<uint32_t> driven, played;
    bool whole = true;
    for (const ClipDefinition& clip : description_.clips) {
        if (!clip.animation) continue;
        takes_.push_back({clip.name, clip.animation.get()});
        anim::TimeRange range = anim::time_range(*clip.animation);
        whole &= range.begin == clip.start && range.end == clip.end;
        const std::vector<anim::Channel>& channels = clip.animation->channels;
        bool meets = std::any_of(channels.begin(), channels.end(),
                                 [&](const anim::Channel& c) { return driven.contains(c.slot); });
        for (const anim::Channel& c : channels)
            if (!meets) driven.insert(c.slot);
    }
    for (const anim::Channel& c : description_.animation.channels) played.insert(c.slot);
    if (takes_.empty() || !whole || driven != played) {
        for (const Take& take : takes_)
            lost(fmt::format("clip '{}'", take.name),
                 "that it moves a part of the scene (all of it)");
        takes_ = {{"", &description_.animation}};
    }
    take_ = &takes_.front();
}

// The values at that time, in at_time_.
void GltfExport::evaluate(const std::vector<Channel>& channels, double time) {
    for (const Channel& c : channels) {
        const anim::Channel& to = *c.channel;
        if (to.slot_step == 1)
            anim::evaluate(*c.sampler, time, to.component,
                           std::span(at_time_).subspan(to.slot, to.count));
        for (uint32_t i = 0; to.slot_step != 1 && i < to.count; ++i)
            anim::evaluate(*c.sampler, time, to.component + i,
                           {&at_time_[to.slot + i * to.slot_step], 1});
    }
}

// at_time_ as it is where nothing moves, for whoever evaluates next.
void GltfExport::to_rest(const std::vector<Channel>& channels) {
    for (const Channel& c : channels)
        for (uint32_t i = 0; i < c.channel->count; ++i) {
            uint32_t slot = c.channel->slot + i * c.channel->slot_step;
            at_time_[slot] = description_.values[slot];
        }
}

std::vector<GltfExport::Channel> GltfExport::channels_of(uint32_t first_value,
                                                         uint32_t count) const {
    std::vector<Channel> result;
    const anim::Animation& animation = *take_->animation;
    for (const anim::Channel& c : animation.channels) {
        const anim::Sampler& sampler = animation.samplers[c.sampler];
        uint32_t end = c.slot + (c.count - 1) * c.slot_step + 1;
        if (c.slot < first_value + count && end > first_value && !sampler.empty())
            result.push_back({&sampler, &c});
    }
    return result;
}

std::vector<GltfExport::Channel> GltfExport::channels_of(std::span<const Transform> stack) const {
    std::vector<Channel> all;
    for (const Transform& t : stack) {
        std::vector<Channel> own = channels_of(t.value, 16);
        all.insert(all.end(), own.begin(), own.end());
    }
    return all;
}

bool GltfExport::is_moved(std::span<const Transform> stack) {
    bool moved = false;
    for (Take& take : takes_) {
        take_ = &take;
        moved = moved || !channels_of(stack).empty();
    }
    return moved;
}

// All times at which a channel has a key, more within pieces where a turn passes 90 degrees; the
// whole played range where a channel goes on beyond its keys.
std::vector<double> GltfExport::key_times(std::span<const Transform> stack,
                                          const std::vector<Channel>& channels) const {
    std::vector<double> times;
    bool endless = false;
    for (const Channel& c : channels) {
        const std::vector<double>& keys = c.sampler->times;
        times.insert(times.end(), keys.begin(), keys.end());
        endless |= c.sampler->pre != anim::Behaviour::Constant ||
                   c.sampler->post != anim::Behaviour::Constant;
        bool angle = false;
        for (const Transform& t : stack)
            angle |= t.kind == TransformKind::Rotate && c.channel->slot <= t.value + 3 &&
                     t.value + 3 < c.channel->slot + c.channel->count;
        for (size_t k = 0; angle && k + 1 < keys.size(); ++k) {
            double a, b;
            uint32_t component = c.channel->component + c.channel->count - 1;
            anim::evaluate(*c.sampler, keys[k], component, {&a, 1});
            anim::evaluate(*c.sampler, keys[k + 1], component, {&b, 1});
            double pieces = std::min(std::ceil(std::abs(b - a) / kLargestTurn), 1e4);
            for (double i = 1; i < pieces; ++i)
                times.push_back(keys[k] + (keys[k + 1] - keys[k]) * i / pieces);
        }
    }
    if (endless) {
        PlayRange range = play_range(description_);
        times.push_back(range.start);
        times.push_back(range.end);
        double step = range.rate > 0 ? 1 / range.rate : 1.0 / 24;
        for (double t = range.start; t < range.end && times.size() < kMostKeys; t += step)
            times.push_back(t);
    }
    times = distinct(std::move(times));
    // glTF's time begins at 0.
    if (!times.empty() && times[0] < 0) {
        times.erase(std::remove_if(times.begin(), times.end(), [](double t) { return t < 0; }),
                    times.end());
        if (times.empty() || times[0] > 0) times.insert(times.begin(), 0.0);
    }
    return times;
}

void GltfExport::add_channel(uint32_t node, const char* path, const std::vector<double>& times,
                             const std::vector<double>& numbers, uint32_t width,
                             const char* interpolation) {
    auto [input, fresh] = key_accessors_.try_emplace(times, 0);
    if (fresh) input->second = accessor(std::vector<float>(times.begin(), times.end()), 1, 0, true);
    uint32_t output = accessor(std::vector<float>(numbers.begin(), numbers.end()), width, 0, false);
    take_->channels.push_back(
        {{"sampler", take_->samplers.size()}, {"target", {{"node", node}, {"path", path}}}});
    take_->samplers.push_back(
        {{"input", input->second}, {"interpolation", interpolation}, {"output", output}});
}

// Steps alone: the values at the keys, held.
bool GltfExport::add_step(uint32_t node, const Path& path) {
    for (const Channel& c : path.channels)
        for (size_t k = 0; k + 1 < c.sampler->interpolations.size(); ++k)
            if (c.sampler->interpolations[k] != anim::Interpolation::Step) return false;
    std::vector<double> numbers(path.times.size() * path.width);
    for (size_t k = 0; k < path.times.size(); ++k) path.at(path.times[k], &numbers[k * path.width]);
    add_channel(node, path.name, path.times, numbers, path.element_width(), "STEP");
    return true;
}

// Cubics whose inner times are the thirds are cubics of the time: tangents are three times the legs
// over the duration. All numbers of the path must come from channels with the same keys.
bool GltfExport::add_spline(uint32_t node, const Path& path, uint32_t first_value) {
    if (path.channels.empty()) return false;
    const std::vector<double>& keys = path.channels[0].sampler->times;
    bool curved = false;
    for (const Channel& c : path.channels) {
        const anim::Sampler& s = *c.sampler;
        if (s.times != keys || keys.size() < 2 || keys[0] < 0 || distinct(keys) != keys ||
            s.kind != anim::SampleKind::Numbers || s.pre != anim::Behaviour::Constant ||
            s.post != anim::Behaviour::Constant)
            return false;
        for (size_t k = 0; k + 1 < keys.size(); ++k) {
            if (s.interpolations[k] == anim::Interpolation::Step) return false;
            if (s.interpolations[k] == anim::Interpolation::Linear) continue;
            curved = true;
            for (uint32_t i = 0; i < c.channel->count; ++i)
                if (!s.curves[k * s.stride + c.channel->component + i].linear_time) return false;
        }
    }
    if (!curved) return false;
    uint32_t width = path.width;
    std::vector<double> numbers(keys.size() * 3 * width, 0.0);  // in tangent, value, out tangent
    for (size_t k = 0; k < keys.size(); ++k) path.at(keys[k], &numbers[(3 * k + 1) * width]);
    for (const Channel& c : path.channels)
        for (uint32_t i = 0; i < c.channel->count; ++i) {
            uint32_t number = c.channel->slot + i * c.channel->slot_step - first_value;
            if (number >= width) return false;
            const anim::Sampler& s = *c.sampler;
            for (size_t k = 0; k + 1 < keys.size(); ++k) {
                double duration = keys[k + 1] - keys[k];
                size_t at = k * s.stride + c.channel->component + i;
                double out, in;
                if (s.interpolations[k] == anim::Interpolation::Linear) {
                    size_t value = k * s.stride + c.channel->component + i;
                    out = in = (s.values[value + s.stride] - s.values[value]) / duration;
                } else {
                    const double* v = s.curves[at].value;
                    out = 3 * (v[1] - v[0]) / duration;
                    in = 3 * (v[3] - v[2]) / duration;
                }
                numbers[(3 * k + 2) * width + number] = out;
                numbers[(3 * (k + 1)) * width + number] = in;
            }
        }
    add_channel(node, path.name, keys, numbers, path.element_width(), "CUBICSPLINE");
    return true;
}

// Straight pieces.
void GltfExport::add_sampled(uint32_t node, const Path& path) {
    StraightKeys keys = reduce_keys(path, path.times, path.tolerance);
    if (keys.worst > 0.01 * path.tolerance) {  // less is rounding
        ++sampled_paths_;
        worst_error_ =
            std::max(worst_error_, keys.worst * options_.animation_error / path.tolerance);
    }
    add_channel(node, path.name, keys.times, keys.numbers, path.element_width(), "LINEAR");
}

// A path that stays where it is needs no keys: it is written into the node, or is one key where
// another take may move the node elsewhere.
void GltfExport::add_path(uint32_t node, Path path) {
    if (path.times.empty()) return;
    uint32_t width = path.width;
    std::vector<double> first(width), now(width);
    path.at(path.times[0], first.data());
    double moves = 0, size = 0;
    auto look = [&](double time) {
        path.at(time, now.data());
        moves = std::max(moves, path.distance(first.data(), now.data()));
        for (uint32_t i = 0; i < width; ++i) size = std::max(size, std::abs(now[i]));
    };
    for (size_t k = 0; k < path.times.size(); ++k) {
        look(path.times[k]);
        if (k + 1 < path.times.size())
            for (double s : kProbes) look(path.times[k] + s * (path.times[k + 1] - path.times[k]));
    }
    double still = 1e-12 * std::max(size, 1e-12);
    if (moves <= still) {
        Json& own = json_["nodes"][node];
        if (takes_.size() == 1) {
            own[path.name] = first;
            return;
        }
        std::vector<double> rest(width, path.name == std::string_view("scale") ? 1.0 : 0.0);
        if (path.rotation) rest[3] = 1;
        if (own.contains(path.name)) rest = own[path.name].get<std::vector<double>>();
        if (path.distance(rest.data(), first.data()) > still)
            add_channel(node, path.name, {path.times[0]}, first, path.element_width(), "STEP");
        return;
    }
    path.tolerance = options_.animation_error;
    if (!path.rotation) path.tolerance *= path.name == std::string_view("scale") ? size : moves;
    if (add_step(node, path)) return;
    add_sampled(node, path);
}

// Where the stack is translations and scales and turns each in its place, one transform's cubics
// are the path's: the one of the kind that moves, or null.
const Transform* GltfExport::only_mover(std::span<const Transform> stack,
                                        TransformKind kind) const {
    const Transform* only = nullptr;
    bool linear_before = true;
    for (const Transform& t : stack) {
        if (t.kind == TransformKind::Matrix || t.kind == TransformKind::Skew ||
            t.kind == TransformKind::Lookat)
            return nullptr;
        if (t.kind == kind) {
            bool moving = !channels_of(t.value, 16).empty();
            if ((only && moving) || !linear_before) return nullptr;
            if (moving) only = &t;
        }
        if (kind == TransformKind::Translate && t.kind != kind) linear_before = false;
        if (kind == TransformKind::Scale && t.kind == kind && only != &t) return nullptr;
    }
    return only;
}

void GltfExport::move_node(uint32_t node, std::span<const Transform> stack, const dmat4& conversion,
                           const std::vector<Channel>& channels) {
    auto trs_at = [this, stack, conversion, channels](double time) {
        evaluate(channels, time);
        dmat4 m = conversion;
        for (const Transform& t : stack) m = m * transform_matrix(t.kind, &at_time_[t.value]);
        Trs trs;
        decompose_trs(m, trs);
        return trs;
    };
    Path path;
    path.channels = channels;
    path.times = key_times(stack, channels);
    auto triple = [](const dvec3& v, double* out) { out[0] = v.x, out[1] = v.y, out[2] = v.z; };
    path.name = "translation";
    path.width = 3;
    path.at = [&](double t, double* out) { triple(trs_at(t).translation, out); };
    auto add = [&](TransformKind kind) {
        const Transform* t = conversion == dmat4(1.0) ? only_mover(stack, kind) : nullptr;
        if (t) {
            Path own = path;
            own.channels = channels_of(t->value, 3);
            if (add_spline(node, own, t->value)) return;
        }
        add_path(node, path);
    };
    add(TransformKind::Translate);
    path.name = "scale";
    path.at = [&](double t, double* out) { triple(trs_at(t).scale, out); };
    // A scale that mirrors is written as another scale with a turn: only sampled.
    bool mirrors = false;
    for (double t : path.times) mirrors |= trs_at(t).scale.x < 0;
    if (mirrors)
        add_path(node, path);
    else
        add(TransformKind::Scale);
    path.name = "rotation";
    path.width = 4;
    path.rotation = true;
    path.at = [&](double t, double* out) {
        std::array<double, 4> q = trs_at(t).rotation;
        std::copy(q.begin(), q.end(), out);
    };
    add_path(node, path);
    to_rest(channels);
}

void GltfExport::move_weights(uint32_t node, const MorphDefinition& morph) {
    for (Take& take : takes_) {
        take_ = &take;
        Path path;
        path.name = "weights";
        path.width = morph.weights.count;
        path.channels = channels_of(morph.weights.offset, morph.weights.count);
        if (path.channels.empty()) continue;
        path.times = key_times({}, path.channels);
        path.at = [&](double time, double* out) {
            evaluate(path.channels, time);
            std::copy_n(&at_time_[morph.weights.offset], morph.weights.count, out);
        };
        if (!add_spline(node, path, morph.weights.offset)) add_path(node, path);
        to_rest(path.channels);
    }
}

}  // namespace kinora
