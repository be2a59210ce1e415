// runtime/scene/build/added_camera.cpp: a camera that no file brought: where it stands and how it
// moves.
#include "runtime/scene/build/added_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/build/added_camera_p.h"
#include "runtime/scene/build/shapes/bounds.h"
#include "runtime/scene/build/shapes/pose_at.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/values.h"

namespace kinora {

namespace {

constexpr int kMostPathTimes = 241;  // that a moving centre is looked up at
constexpr char kName[] = "default camera";

}  // namespace

// All shapes, or those at and below the node that is looked at.
bool AddedCamera::choose_subject(Diagnostics& diagnostics) {
    if (!options_.at_node.empty()) {
        at_node_ = find_node(scene_, tree_, options_.at_node);
        if (at_node_ == kNone) {
            diagnostics.report(Code::NODE_UNKNOWN, Location{}, options_.at_node);
            return false;
        }
    }
    for (uint32_t h = 0; h < scene_.shapes.size(); ++h) {
        uint32_t n = scene_.shapes[h].node;
        while (n != at_node_ && n != kNone) n = tree_.parent(n);
        if (n == at_node_) subject_.push_back(h);
    }
    return true;
}

// The subject's centre over the range; where it has no vertices (a joint) the node's place.
void AddedCamera::find_path() {
    times_ = played_times(scene_);
    bool moves = options_.follow || (at_node_ != kNone && options_.from);
    if (moves && times_.size() > 1) {
        double rate = scene_.options.frame_rate > 0 ? scene_.options.frame_rate : 24;
        double frames = std::ceil((times_.back() - times_.front()) * rate);
        times_ = played_times(
            scene_, int(std::clamp(frames + 1, double(kPlayedTimes), double(kMostPathTimes))));
    }
    bool any_centre = !turns() && !options_.from && at_node_ == kNone;
    if (!options_.follow && (options_.at || any_centre)) {
        base_ = options_.at.value_or(scene_.origin);
        return;
    }
    Bounds all;
    for (double time : times_) {
        if (times_.size() > 1) pose_at(scene_, time);
        Bounds now;
        for (const dvec3& p : subject_now(true)) now.add(p);
        if (now.empty() && at_node_ != kNone) now.add(dvec3(scene_.start.nodes[at_node_].world[3]));
        if (now.empty()) now.add(path_.empty() ? scene_.origin : path_.back());
        all.add(now.low);
        all.add(now.high);
        path_.push_back(0.5 * (now.low + now.high));
    }
    dvec3 middle = 0.5 * (all.low + all.high);
    base_ = options_.at.value_or(options_.follow ? path_.front() : middle);
}

dvec3 AddedCamera::origin(size_t time) const {
    return options_.follow ? base_ + path_[time] - path_[0] : base_;
}

// At the place that was asked for.
Stand AddedCamera::stand() const {
    dvec3 to_eye = *options_.from - base_;
    Stand result;
    result.axes = axes_towards(glm::length(to_eye) > 0 ? to_eye : frame_.back, frame_);
    result.eye = to_eye;
    result.reach = scene_.size;
    return result;
}

uint32_t AddedCamera::append(std::initializer_list<double> numbers) {
    std::vector<double>& values = scene_.description->values;
    uint32_t offset = uint32_t(values.size());
    values.insert(values.end(), numbers);
    values.resize(offset + 16, 0.0);
    return offset;
}

// Right to left: the camera beside the origin, turned about it, moved with it.
NodeDefinition AddedCamera::node(const Stand& stand) {
    NodeDefinition node;
    node.id = node.name = kName;
    auto numbers = [](std::span<const dvec3> points, dvec3 offset) {
        std::vector<double> result;
        for (dvec3 p : points)
            for (int k = 0; k < 3; ++k) result.push_back(p[k] + offset[k]);
        return result;
    };
    uint32_t slot = append({base_.x, base_.y, base_.z});
    node.transforms.push_back({TransformKind::Translate, slot});
    bool moves = times_.size() > 1 && !path_.empty();
    if (moves && options_.follow)
        motions_.push_back({slot, times_, numbers(path_, base_ - path_[0])});
    if (turns()) {
        uint32_t turn = append({frame_.up.x, frame_.up.y, frame_.up.z, 0});
        node.transforms.push_back({TransformKind::Rotate, turn});
        double start = options_.turn_start;
        motions_.push_back(
            {turn + 3, {start, start + options_.turn_seconds}, {0, 360}, anim::Behaviour::Linear});
    }
    dvec3 to = stand.eye - stand.axes.back * std::max(glm::length(stand.eye), scene_.size);
    dvec3 up = stand.axes.up;
    if (options_.from) {  // what is looked at may move
        to = dvec3(0.0);
        up = frame_.up;
    }
    uint32_t look =
        append({stand.eye.x, stand.eye.y, stand.eye.z, to.x, to.y, to.z, up.x, up.y, up.z});
    node.transforms.push_back({TransformKind::Lookat, look});
    if (moves && options_.from && at_node_ != kNone && !options_.follow && !turns())
        motions_.push_back({look + 3, times_, numbers(path_, -base_)});
    return node;
}

CameraDefinition AddedCamera::camera(const Stand& stand) {
    CameraDefinition camera;
    camera.id = camera.name = kName;
    double aspect = wanted_aspect(scene_.options);
    if (stand.half_height > 0) {
        camera.orthographic = true;
        camera.x = slot(stand.half_height * aspect);
        camera.y = slot(stand.half_height);
    } else {
        // Both: a picture of another shape still shows all.
        camera.x = slot(2 * std::atan(half_height() * aspect) * 180 / kPi);
        camera.y = slot(2 * std::atan(half_height()) * 180 / kPi);
    }
    double distance = glm::length(stand.eye);
    camera.znear = slot(1e-3 * std::max(distance, 1e-3 * scene_.size));
    camera.zfar = slot(distance + 4 * std::max(stand.reach, 1e-6 * scene_.size));
    return camera;
}

void AddedCamera::animate(uint32_t node) {
    if (motions_.empty()) return;
    SceneDescription& description = *scene_.description;
    // The range played stays what it is: these keys are not the scene's.
    description.start_time = scene_.options.start_time;
    description.end_time = scene_.options.end_time;
    anim::Animation& animation = description.animation;
    for (const Motion& motion : motions_) {
        anim::SamplerSource source;
        source.times = motion.times;
        source.values = motion.values;
        source.stride = uint32_t(motion.values.size() / motion.times.size());
        source.pre = source.post = motion.beyond;
        anim::Channel channel;
        channel.sampler = uint32_t(animation.samplers.size());
        channel.slot = motion.slot;
        channel.count = source.stride;
        channel.owner = scene_.nodes[node].definition;
        animation.samplers.push_back(anim::make_sampler(source));
        animation.channels.push_back(channel);
        for (uint32_t i = 0; i < source.stride; ++i) description.animated[motion.slot + i] = true;
    }
    animation = anim::make_animation(std::move(animation.samplers), std::move(animation.channels));
    scene_.nodes[node].can_move = true;
}

void AddedCamera::add(Diagnostics& diagnostics) {
    find_path();
    Stand chosen = options_.from ? stand() : frame(diagnostics);
    SceneDescription& description = *scene_.description;
    description.cameras.push_back(camera(chosen));
    uint32_t index = tree_.add(node(chosen), kNone);
    animate(index);
    scene_.cameras.push_back({uint32_t(description.cameras.size() - 1), index, kName});
    scene_.start.camera = uint32_t(scene_.cameras.size() - 1);
    scene_.added.push_back(kName);
    pose_at(scene_, scene_.options.start_time);
}

double wanted_aspect(const SceneOptions& options) {
    return options.height > 0 ? double(options.width) / options.height : 16.0 / 9.0;
}

bool add_camera(Scene& scene, NodeTree& tree, const ViewWord& view, Diagnostics& diagnostics) {
    AddedCamera added(scene, tree, view);
    if (!added.choose_subject(diagnostics)) return false;
    added.add(diagnostics);
    return true;
}

std::string path_of(const NodeTree& tree, uint32_t node) {
    std::string path;
    for (uint32_t n = node; n != kNone; n = tree.parent(n)) {
        const NodeDefinition& step = tree.definition(n);
        path = (step.id.empty() ? step.name : step.id) + (path.empty() ? "" : "/" + path);
    }
    return path;
}

uint32_t find_node(const SceneNodes& scene, const NodeTree& tree, const std::string& wanted) {
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        const NodeDefinition& node = tree.definition(n);
        if (wanted == node.id || wanted == node.name || wanted == path_of(tree, n)) return n;
    }
    return kNone;
}

}  // namespace kinora
