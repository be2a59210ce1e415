// runtime/build/dicing.cpp: displaced meshes diced for the closest views of the range played.
//
// How fine a mesh is diced depends on the scene, its camera, the range played and the size of the
// picture, not on which frames are rendered: a frame is the same alone and in a sequence.
#include <algorithm>

#include "runtime/build/displacement_p.h"
#include "runtime/description/findings.h"
#include "runtime/scene/camera.h"
#include "runtime/vertices/deform.h"

namespace kinora {

namespace {

constexpr int kViewSamples = 8;      // of the range played, and its end
constexpr int kBetween = 8;          // times looked at from one of them to the next
constexpr double kTooCoarse = 1.25;  // dice_error, there
constexpr double kCoarser = 1.25;    // from one try to the next where the limit binds
constexpr double kCoarsest = 1e7;    // pixels: nothing is split any more

dvec3 point(std::span<const vec4> pose, const uint32_t corners[3], DicePoint at) {
    dvec3 sum(0.0);
    for (int k = 0; k < 3; ++k) sum += double(at.weight(k)) / kDiceOne * dvec3(pose[corners[k]]);
    return sum;
}

}  // namespace

// Where the displaced meshes are for the camera, as both stand.
void SceneBuilder::add_views(std::vector<Displaced>& all) {
    Scene& scene = *scene_;
    for (Displaced& displaced : all)
        for (uint32_t h : displaced.shapes) {
            const Shape& shape = scene.shapes[h];
            DiceView view;
            view.camera = scene.view;
            if (displaced.deforms) {
                view.pose = shape.positions;
            } else {
                view.accel_from_pose = accel_from_rest(scene, shape, displaced.base.anchor);
            }
            bool seen = std::any_of(displaced.views.begin(), displaced.views.end(),
                                    [&](const DiceView& v) { return v.same(view); });
            if (!seen) displaced.views.push_back(std::move(view));
        }
}

// For the picture that dicing is for. False where the camera makes none.
bool SceneBuilder::place_dice_camera() {
    Scene& scene = *scene_;
    const SceneOptions& options = scene.options;
    double aspect = camera_aspect(scene).value_or(16.0 / 9.0);
    int width = std::max(options.width, 1);
    int height = options.height > 0 ? options.height : std::max(1, int(width / aspect + 0.5));
    return !raytrace::is_error(place_camera(scene, width, height));
}

void SceneBuilder::add_view(std::vector<Displaced>& all, double time) {
    evaluate(time);
    deform_now();
    view_times_.push_back(time);
    if (place_dice_camera()) add_views(all);
}

void SceneBuilder::back_to_start() {
    evaluate(scene_->options.start_time);
    deform_now();
    place_dice_camera();
}

void SceneBuilder::find_views(std::vector<Displaced>& all) {
    Scene& scene = *scene_;
    const SceneOptions& options = scene.options;
    bool moves = !description_.animation.channels.empty() && options.end_time > options.start_time;
    if (!moves) {
        if (place_dice_camera()) add_views(all);
    } else {
        double length = options.end_time - options.start_time;
        for (int s = 0; s <= kViewSamples; ++s)
            add_view(all, options.start_time + length * (double(s) / kViewSamples));
    }
    if (again_) {
        evaluate(again_->view.time);
        deform_now();
        bool placed = place_dice_camera();
        if (again_->view.camera) scene.view = *again_->view.camera;
        if (placed || again_->view.camera) add_views(all);
    }
    if (moves || again_) back_to_start();
}

// Looks at what was diced from more times: the one between each two views that it is most too
// coarse for becomes a view of its own. True where there is one. What a skin or morph moves is not
// asked: posing it so often would take long.
bool SceneBuilder::refine_views(std::vector<Displaced>& all) {
    Scene& scene = *scene_;
    auto asked = [](const auto& watched) { return watched->ends.empty(); };
    if (std::ranges::none_of(scene.watched, asked)) return false;
    std::vector<double> known = view_times_, worst;
    for (size_t s = 0; s + 1 < known.size(); ++s) {
        double most = kTooCoarse, at = known[s];
        for (int k = 1; k < kBetween; ++k) {
            double time = known[s] + (known[s + 1] - known[s]) * (double(k) / kBetween);
            evaluate(time);
            double error = place_dice_camera() ? dice_error(scene) : 0;
            if (!(error > most)) continue;
            most = error;
            at = time;
        }
        if (at > known[s]) worst.push_back(at);
    }
    for (double time : worst) add_view(all, time);
    if (known.size() > 1) back_to_start();
    return !worst.empty();
}

// `pixels`, or more where a coarse try tells that it would take more than twice the limit: fine
// tries that fail cost much more.
double SceneBuilder::coarse_enough(std::vector<Displaced>& all, double pixels) {
    constexpr double kProbe = 8;
    double limit = double(scene_->options.dice_limit), base = 0, probed = 0;
    while (pixels < kCoarsest && !dice_to(all, kProbe * pixels, scene_->options.dice_limit))
        pixels *= kProbe;
    for (const Displaced& displaced : all) {
        if (!displaced.any_diced() || !displaced.made) continue;
        for (const MeshGroup& group : displaced.base.groups)
            base += double(group.triangles.size() / 3);
        probed += double(displaced.made->triangles());
    }
    double added = (probed - base) * kProbe * kProbe;
    for (; base + added > 2 * limit && pixels < kCoarsest; pixels *= kCoarser)
        added /= kCoarser * kCoarser;
    return pixels;
}

void SceneBuilder::dice(std::vector<Displaced>& all) {
    Scene& scene = *scene_;
    const SceneOptions& options = scene.options;
    double pixels = coarse_enough(all, std::max(options.dice, 1e-3));
    while (pixels < kCoarsest && !dice_to(all, pixels, options.dice_limit)) pixels *= kCoarser;
    if (pixels >= kCoarsest) dice_to(all, pixels, ~size_t(0) / 2);
    scene.dice.pixels = pixels;
    scene.dice.triangles = scene.dice.vertices = 0;
    for (const Displaced& displaced : all) {
        if (!displaced.any_diced()) continue;
        scene.dice.triangles += displaced.made->triangles();
        scene.dice.vertices += displaced.made->mesh.positions.size();
    }
}

void SceneBuilder::report_dice_limit() {
    const SceneOptions& options = scene_->options;
    double asked = std::max(options.dice, 1e-3);
    auto told = [](const Finding& finding) { return finding.info == &Code::DICE_LIMIT; };
    if (again_ && std::ranges::any_of(diagnostics_.findings(), told)) return;
    if (scene_->dice.pixels > asked)
        diagnostics_.report(Code::DICE_LIMIT, Location{}, scene_->dice.pixels, options.dice,
                            options.dice_limit);
}

// False when all together come to more than `limit` triangles.
bool SceneBuilder::dice_to(std::vector<Displaced>& all, double pixels, size_t limit) {
    size_t used = 0;
    for (Displaced& displaced : all) {
        const Mesh& base = displaced.base;
        auto too_long = [&](const uint32_t corners[3], DicePoint a, DicePoint b) {
            if (pixels >= kCoarsest || stopped()) return false;
            return std::any_of(
                displaced.views.begin(), displaced.views.end(), [&](const DiceView& view) {
                    std::span<const vec4> pose = view.pose.empty() ? base.positions : view.pose;
                    dvec3 from(view.accel_from_pose * dvec4(point(pose, corners, a), 1.0));
                    dvec3 to(view.accel_from_pose * dvec4(point(pose, corners, b), 1.0));
                    return edge_pixels(view.camera, from, to) > kLongestEdge * pixels;
                });
        };
        bool counts = displaced.any_diced();
        displaced.made.reset();
        displaced.made =
            dice_mesh(base, displaced.diced, too_long, counts ? limit - used : ~size_t(0) / 2);
        if (!displaced.made) return false;
        if (counts) used += displaced.made->triangles();
    }
    return true;
}

// Edges of what was diced are kept, so that a frame can tell whether they are short enough for it.
void SceneBuilder::watch_edges(std::vector<Displaced>& all) {
    Scene& scene = *scene_;
    scene.watched.clear();
    size_t triangles = 0;
    for (const Displaced& displaced : all)
        if (displaced.any_diced())
            triangles += displaced.made->triangles() * displaced.shapes.size();
    for (Displaced& displaced : all) {
        if (!displaced.any_diced() || stopped()) continue;
        const Shape& first = scene.shapes[displaced.shapes[0]];
        auto watched = std::make_unique<WatchedEdges>();
        watched->shapes = displaced.shapes;
        watched->anchor = displaced.base.anchor;
        dmat3 world(scene.nodes[first.node].world * first.conversion);
        choose_edges(displaced.base, *displaced.made, displaced.diced, world, displaced.deforms,
                     triangles, *watched);
        displaced.watched = watched.get();
        scene.watched.push_back(std::move(watched));
    }
}

}  // namespace kinora
