// runtime/scene/build/displacement/dice_views.cpp: the views that displaced meshes are diced for.
#include "runtime/scene/build/displacement/dice_views.h"

#include <algorithm>

#include "runtime/scene/build/shapes/pose_at.h"
#include "runtime/scene/camera.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/values.h"
#include "runtime/scene/vertices/dice_error.h"

namespace kinora {

namespace {

constexpr int kViewSamples = 8;      // of the range played, and its end
constexpr int kBetween = 8;          // times looked at from one of them to the next
constexpr double kTooCoarse = 1.25;  // dice_error, there

}  // namespace

bool DiceView::same(const DiceView& o) const {
    return pose.empty() && o.pose.empty() && accel_from_pose == o.accel_from_pose &&
           camera.eye == o.camera.eye && camera.right == o.camera.right &&
           camera.up == o.camera.up && camera.half_width == o.camera.half_width &&
           camera.half_height == o.camera.half_height && camera.width == o.camera.width &&
           camera.znear == o.camera.znear;
}

DiceViews::DiceViews(Scene& scene, std::span<const DisplacedMesh> meshes)
    : scene_(scene), meshes_(meshes), views_(meshes.size()) {}

void DiceViews::find(const CloserView* closer) {
    const SceneOptions& options = scene_.options;
    bool moves =
        !scene_.description->animation.channels.empty() && options.end_time > options.start_time;
    if (!moves) {
        if (set_dice_view()) add_now();
    } else {
        double length = options.end_time - options.start_time;
        for (int s = 0; s <= kViewSamples; ++s)
            add_at(options.start_time + length * (double(s) / kViewSamples));
    }
    if (closer) {
        pose_at(scene_, closer->time);
        bool valid = set_dice_view();
        if (closer->camera) scene_.start.view = *closer->camera;
        if (valid || closer->camera) add_now();
    }
    if (moves || closer) back_to_start();
}

// The start's view for the picture that dicing is for. False where the camera makes none.
bool DiceViews::set_dice_view() {
    const SceneOptions& options = scene_.options;
    double aspect = camera_aspect(scene_).value_or(16.0 / 9.0);
    int width = std::max(options.width, 1);
    int height = options.height > 0 ? options.height : std::max(1, int(width / aspect + 0.5));
    return !raytrace::is_error(set_view(scene_, scene_.start, width, height));
}

// Where the displaced meshes are for the camera, as both stand.
void DiceViews::add_now() {
    for (size_t m = 0; m < meshes_.size(); ++m)
        for (uint32_t h : meshes_[m].shapes) {
            const Shape& shape = scene_.shapes[h];
            DiceView view;
            view.camera = scene_.start.view;
            if (meshes_[m].deforms)
                view.pose = scene_.start.shapes[h].positions;
            else
                view.accel_from_pose =
                    accel_from_rest(scene_, scene_.start, shape, meshes_[m].base.anchor);
            bool seen = std::any_of(views_[m].begin(), views_[m].end(),
                                    [&](const DiceView& v) { return v.same(view); });
            if (!seen) views_[m].push_back(std::move(view));
        }
}

void DiceViews::add_at(double time) {
    pose_at(scene_, time);
    times_.push_back(time);
    if (set_dice_view()) add_now();
}

void DiceViews::back_to_start() {
    pose_at(scene_, scene_.options.start_time);
    set_dice_view();
}

// Between two times: the one for which what was diced is most too coarse; `from` if none is.
double DiceViews::coarsest_time(double from, double to) {
    double most = kTooCoarse, result = from;
    for (int k = 1; k < kBetween; ++k) {
        double time = from + (to - from) * (double(k) / kBetween);
        evaluate_anew(scene_, scene_.start, time);
        double error = set_dice_view() ? dice_error(*scene_.description, scene_, scene_.start) : 0;
        if (!(error > most)) continue;
        most = error;
        result = time;
    }
    return result;
}

bool DiceViews::refine() {
    auto rigid = [](const auto& watched) { return watched->ends.empty(); };
    if (std::ranges::none_of(scene_.watched, rigid)) return false;
    std::vector<double> known = times_, worst;
    for (size_t s = 0; s + 1 < known.size(); ++s) {
        double time = coarsest_time(known[s], known[s + 1]);
        if (time > known[s]) worst.push_back(time);
    }
    for (double time : worst) add_at(time);
    if (known.size() > 1) back_to_start();
    return !worst.empty();
}

}  // namespace kinora
