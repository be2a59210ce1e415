// runtime/build/added_camera.cpp: a camera that no file brought: where it stands, what it frames
// and how it moves.
#include "runtime/build/added_camera.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "runtime/build/coverage.h"
#include "runtime/build/shapes/bounds.h"
#include "runtime/build/shapes/pose_at.h"
#include "runtime/build/shapes/shown_vertices.h"
#include "runtime/description/findings.h"
#include "runtime/scene/values.h"

namespace kinora {

namespace {

constexpr double kYfov = 37.0;       // degrees
constexpr double kMostYfov = 170;    // of a picture's width, too
constexpr int kMostPathTimes = 241;  // that a moving centre is looked up at
// What is stray: further from the median vertex than so many times what all but a few are.
constexpr double kCoreShare = 0.98, kCoreReach = 1.25;
constexpr char kName[] = "default camera";

// Keys for numbers of a node that is being added.
struct Motion {
    uint32_t slot = kNone;  // in SceneDescription::values
    std::vector<double> times, values;
    anim::Behaviour beyond = anim::Behaviour::Constant;
};

// Where a camera stands, relative to `origin`, which may move.
struct Stand {
    ViewAxes axes;
    dvec3 eye{0.0};
    double half_height = 0;  // of parallel rays; 0: perspective
    double reach = 0;        // how far from `origin` what it frames is
};

class AddedCamera {
  public:
    AddedCamera(Scene& scene, NodeTree& tree, const ViewWord& view)
        : scene_(scene),
          tree_(tree),
          options_(scene.options.view),
          view_(view),
          frame_(up_axis_frame(scene.description->up_axis)),
          vertices_(scene) {}

    bool choose_subject(Diagnostics& diagnostics);
    void add(Diagnostics& diagnostics);

  private:
    bool parallel() const { return view_.parallel && options_.yfov == 0 && !options_.from; }
    bool turns() const { return options_.turn_seconds > 0; }
    double half_height() const;  // at distance 1
    void find_path();
    dvec3 origin(size_t time) const;
    Stand stand() const;
    std::span<const dvec3> subject_now(bool still);
    Stand frame(dvec3 back, bool core_only);
    Stand frame(Diagnostics& diagnostics);
    double covered(const Stand& stand);
    uint32_t append(std::initializer_list<double> numbers);
    ValueSlot slot(double number) { return {append({number}), 1}; }
    NodeDefinition node(const Stand& stand);
    CameraDefinition camera(const Stand& stand);
    void animate(uint32_t node);

    Scene& scene_;
    NodeTree& tree_;
    const ViewOptions& options_;
    const ViewWord& view_;
    ViewAxes frame_;
    ShownVertices vertices_;
    uint32_t at_node_ = kNone;
    std::vector<uint32_t> subject_;  // shapes
    std::vector<dvec3> points_;
    std::vector<double> times_;
    std::vector<dvec3> path_;  // the subject's centre at these times; empty: not asked for
    dvec3 base_{0.0};          // of the origin at the first time
    std::vector<Motion> motions_;
};

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

double AddedCamera::half_height() const {
    double yfov = options_.yfov > 0 ? options_.yfov : kYfov;
    double half = std::tan(0.5 * radians(yfov));
    // A picture may be so wide that its other angle would come near 180 degrees.
    return std::min(half, std::tan(0.5 * radians(kMostYfov)) / wanted_aspect(scene_.options));
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
        if (now.empty() && at_node_ != kNone) now.add(dvec3(scene_.nodes[at_node_].world[3]));
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

// Vertices far from all others: left out where they make a speck of the rest.
struct Core {
    dvec3 middle{0.0};
    double reach = std::numeric_limits<double>::infinity();
};
Core core_of(std::span<const dvec3> points) {
    constexpr size_t kMost = 20'000;
    size_t step = points.size() / kMost + 1;
    std::vector<double> sorted;
    auto quantile = [&](double share, auto&& number) {
        sorted.clear();
        for (size_t i = 0; i < points.size(); i += step) sorted.push_back(number(points[i]));
        auto at = sorted.begin() + ptrdiff_t(share * double(sorted.size() - 1));
        std::nth_element(sorted.begin(), at, sorted.end());
        return *at;
    };
    Core core;
    if (points.empty()) return core;
    for (int k = 0; k < 3; ++k) core.middle[k] = quantile(0.5, [&](dvec3 p) { return p[k]; });
    core.reach =
        kCoreReach * quantile(kCoreShare, [&](dvec3 p) { return glm::length(p - core.middle); });
    return core;
}

// Vertices as the shapes stand; `still`: also those of shapes that never move.
std::span<const dvec3> AddedCamera::subject_now(bool still) {
    points_.clear();
    for (uint32_t h : subject_) {
        if (!still && scene_.shapes[h].kind == raytrace::GeometryKind::Static) continue;
        std::span<const dvec3> of_shape = vertices_.of(h);
        points_.insert(points_.end(), of_shape.begin(), of_shape.end());
    }
    return points_;
}

// From a direction, as near as what is framed allows.
Stand AddedCamera::frame(dvec3 back, bool core_only) {
    Stand result;
    result.axes = axes_towards(back, frame_);
    Framing framing(result.axes, half_height() * wanted_aspect(scene_.options), half_height());
    if (turns()) framing.turn_about(frame_.up);
    if (options_.at) framing.keep_centre();
    for (size_t t = 0; t < times_.size(); ++t) {
        if (times_.size() > 1) pose_at(scene_, times_[t]);
        std::span<const dvec3> points = subject_now(t == 0 || options_.follow || core_only);
        Core core = core_only ? core_of(points) : Core();
        for (const dvec3& p : points) {
            if (glm::length(p - core.middle) > core.reach) continue;
            framing.add(p - origin(t));
            result.reach = std::max(result.reach, glm::length(p - origin(t)));
        }
    }
    if (framing.empty()) {  // a joint: the neighbourhood of its place
        result.reach = 0.1 * scene_.size;
        for (double side : {-result.reach, result.reach})
            for (const dvec3& axis : {frame_.right, frame_.up, frame_.back})
                framing.add(side * axis);
    }
    if (parallel()) {
        Framing::Parallel eye = framing.parallel_eye();
        result.eye = eye.eye;
        result.half_height = eye.half_height;
    } else {
        result.eye = framing.perspective_eye();
    }
    return result;
}

// The largest share of the picture that the scene takes at one of the times, as far as kLittle.
double AddedCamera::covered(const Stand& stand) {
    raytrace::CameraOptics optics;
    optics.orthographic = stand.half_height > 0;
    optics.y = optics.orthographic ? stand.half_height : 2 * std::atan(half_height());
    constexpr int kHeight = 1024;
    int width = std::max(1, int(std::lround(kHeight * wanted_aspect(scene_.options))));
    double most = 0;
    for (size_t t = 0; t < times_.size() && most < kLittle; ++t) {
        if (times_.size() > 1) pose_at(scene_, times_[t]);
        dmat4 matrix(dvec4(stand.axes.right, 0), dvec4(stand.axes.up, 0), dvec4(stand.axes.back, 0),
                     dvec4(origin(t) + stand.eye, 1));
        raytrace::Camera camera;
        raytrace::make_camera(optics, matrix, width, kHeight, scene_.origin, scene_.size, camera);
        most = std::max(most, covered_share(scene_, camera, kLittle));
    }
    return most;
}

// In the view's direction. The automatic view looks for another one where it shows a speck: what is
// flat may be seen edge-on, and what is stray may be far.
Stand AddedCamera::frame(Diagnostics& diagnostics) {
    dvec3 sideways = view_.right * frame_.right,
          rest = view_.up * frame_.up + view_.back * frame_.back;
    Stand best = frame(sideways + rest, false);
    if (view_.word != "auto" || at_node_ != kNone || options_.at) return best;
    double most = covered(best);
    for (auto [side, core_only] : {std::pair(-1, false), {1, true}, {-1, true}}) {
        if (most >= kLittle) break;
        Stand other = frame(double(side) * sideways + rest, core_only);
        double share = covered(other);
        // Nothing is left out for less than a picture.
        if (share <= most || (core_only && share < kLittle)) continue;
        if (core_only) diagnostics.report(Code::SCENE_STRAY, Location{});
        best = other;
        most = share;
    }
    return best;
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
    scene_.camera = uint32_t(scene_.cameras.size() - 1);
    scene_.added.push_back(kName);
    pose_at(scene_, scene_.options.start_time);
}

}  // namespace

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

uint32_t find_node(const Scene& scene, const NodeTree& tree, const std::string& wanted) {
    for (uint32_t n = 0; n < scene.nodes.size(); ++n) {
        const NodeDefinition& node = tree.definition(n);
        if (wanted == node.id || wanted == node.name || wanted == path_of(tree, n)) return n;
    }
    return kNone;
}

}  // namespace kinora
