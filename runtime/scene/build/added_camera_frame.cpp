// runtime/scene/build/added_camera_frame.cpp: what a camera that no file brought frames.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/scene/build/added_camera_p.h"
#include "runtime/scene/build/coverage.h"
#include "runtime/scene/build/shapes/bounds.h"
#include "runtime/scene/build/shapes/pose_at.h"
#include "runtime/scene/description/findings.h"

namespace kinora {

namespace {

constexpr double kYfov = 37.0;     // degrees
constexpr double kMostYfov = 170;  // of a picture's width, too
constexpr double kNothing = 5e-4;  // of a picture: two of the rays of covered_share
constexpr double kSpeck = 1e-2;    // under which a part is looked at instead of all
// The share of the times at which a part has to be seen: one that is there at the start, another.
constexpr double kOftenAtStart = 1.0 / 3, kOften = 1.0 / 2;

}  // namespace

double AddedCamera::half_height() const {
    double yfov = options_.yfov > 0 ? options_.yfov : kYfov;
    double half = std::tan(0.5 * radians(yfov));
    // A picture may be so wide that its other angle would come near 180 degrees.
    return std::min(half, std::tan(0.5 * radians(kMostYfov)) / wanted_aspect(scene_.options));
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

// From the view's direction, or (-1) from its mirror image, as near as what is framed allows.
Stand AddedCamera::frame(int side, const Part& part) {
    Stand result;
    result.axes = axes_towards(
        double(side) * view_.right * frame_.right + view_.up * frame_.up + view_.back * frame_.back,
        frame_);
    Framing framing(result.axes, half_height() * wanted_aspect(scene_.options), half_height());
    if (turns()) framing.turn_about(frame_.up);
    if (options_.at) framing.keep_centre();
    for (size_t t = 0; t < times_.size(); ++t) {
        if (times_.size() > 1) pose_at(scene_, times_[t]);
        std::span<const dvec3> points = subject_now(t == 0 || options_.follow || part.core_of_each);
        Core core = part.near;
        if (part.core_of_each) {
            core = core_of(points);
            core.middle -= origin(t);
        }
        for (const dvec3& p : points) {
            dvec3 about = p - origin(t);
            if (glm::length(about - core.middle) > core.reach) continue;
            framing.add(about);
            result.reach = std::max(result.reach, glm::length(about));
        }
    }
    if (framing.empty()) {  // a joint: the neighbourhood of its place
        result.reach = 0.1 * scene_.size;
        for (double way : {-result.reach, result.reach})
            for (const dvec3& axis : {frame_.right, frame_.up, frame_.back})
                framing.add(way * axis);
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

// The share of the picture that the scene takes at that time, as far as kLittle.
double AddedCamera::covered_at(const Stand& stand, size_t time) {
    raytrace::CameraOptics optics;
    optics.orthographic = stand.half_height > 0;
    optics.y = optics.orthographic ? stand.half_height : 2 * std::atan(half_height());
    constexpr int kHeight = 1024;
    int width = std::max(1, int(std::lround(kHeight * wanted_aspect(scene_.options))));
    if (times_.size() > 1) pose_at(scene_, times_[time]);
    dmat4 matrix(dvec4(stand.axes.right, 0), dvec4(stand.axes.up, 0), dvec4(stand.axes.back, 0),
                 dvec4(origin(time) + stand.eye, 1));
    raytrace::Camera camera;
    raytrace::make_camera(optics, matrix, width, kHeight, scene_.origin, scene_.size, camera);
    return covered_share(scene_, scene_.start, camera, kLittle);
}

JudgedStand AddedCamera::judged(const Stand& stand) {
    JudgedStand result{stand, 0};
    for (size_t t = 0; t < times_.size() && result.share < kLittle; ++t)
        result.share = std::max(result.share, covered_at(stand, t));
    return result;
}

bool AddedCamera::shows_often(const Stand& stand) {
    size_t shown = 0;
    bool at_start = false;
    for (size_t t = 0; t < times_.size(); ++t) {
        bool shows = covered_at(stand, t) >= kLittle;
        at_start |= shows && t == 0;
        shown += shows;
    }
    return double(shown) >= (at_start ? kOftenAtStart : kOften) * double(times_.size());
}

// A few vertices far from all others: nothing is left out for less than a picture.
bool AddedCamera::leave_strays_out(JudgedStand& best) {
    for (int side : {1, -1}) {
        JudgedStand core = judged(frame(side, {.core_of_each = true, .near = {}}));
        if (core.share < kLittle) continue;
        best = core;
        return true;
    }
    return false;
}

// What is there at the start and comes back to its place is framed, and what goes far away is not;
// else what is there in the middle of the range, or at its end. Half of the scene is left out where
// there would be nothing to see at all.
bool AddedCamera::stay_with_most(JudgedStand& best, Diagnostics& diagnostics) {
    size_t last = times_.size() - 1;
    std::vector<size_t> chosen{0};
    if (last > 0) chosen.insert(chosen.end(), {times_.size() / 2, last});
    for (double share : {kCoreShare, 0.5}) {
        if (share < kCoreShare && best.share >= kNothing) break;
        for (size_t time : chosen) {
            if (last > 0) pose_at(scene_, times_[time]);
            Core near = core_of(subject_now(true), share);
            near.middle -= origin(time);
            for (int side : {1, -1}) {
                Stand other = frame(side, {.core_of_each = false, .near = near});
                if (!shows_often(other)) continue;
                best = {other, kLittle};
                report_farthest(Code::SCENE_FAR_PART, near.middle, diagnostics);
                return true;
            }
        }
    }
    return false;
}

// Names the shape that comes to be the furthest from a place (about the origin).
void AddedCamera::report_farthest(const FindingInfo& code, dvec3 middle, Diagnostics& diagnostics) {
    double most = -1;
    uint32_t farthest = kNone;
    for (size_t t = 0; t < times_.size(); ++t) {
        if (times_.size() > 1) pose_at(scene_, times_[t]);
        for (uint32_t h : subject_)
            for (const dvec3& p : vertices_.of(h)) {
                double distance = glm::length(p - origin(t) - middle);
                if (distance <= most) continue;
                most = distance;
                farthest = h;
            }
    }
    if (farthest == kNone) return;
    const NodeDefinition& node = tree_.definition(tree_.named(scene_.shapes[farthest].node));
    const std::string& name = node.id.empty() ? node.name : node.id;
    Finding& finding = diagnostics.report(code, node.where, name, most);
    if (!name.empty()) finding.help = fmt::format("--hide '{}' leaves it out", name);
}

// In the view's direction. The automatic view looks for another one where it shows a speck: what is
// flat may be seen edge-on, what is stray or goes away may be far.
Stand AddedCamera::frame(Diagnostics& diagnostics) {
    Stand all = frame(1, {});
    if (view_.word != "auto" || at_node_ != kNone || options_.at) return all;
    JudgedStand best = judged(all);
    if (best.share >= kLittle) return best.stand;
    if (JudgedStand other = judged(frame(-1, {})); other.share > best.share) best = other;
    if (best.share >= kLittle) return best.stand;
    if (leave_strays_out(best)) {
        diagnostics.report(Code::SCENE_STRAY, Location{});
        return best.stand;
    }
    if (best.share < kSpeck && stay_with_most(best, diagnostics)) return best.stand;
    if (best.share >= kNothing || !anything_to_draw(scene_)) return best.stand;
    if (times_.size() > 1) pose_at(scene_, times_[0]);
    dvec3 middle = core_of(subject_now(true)).middle - origin(0);
    report_farthest(Code::SCENE_SPECKS, middle, diagnostics);
    return best.stand;
}

}  // namespace kinora
