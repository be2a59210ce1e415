// runtime/scene/build/displacement/dicing.cpp: displaced meshes split finely enough for their
// views.
#include "runtime/scene/build/displacement/dicing.h"

#include <algorithm>

#include "runtime/scene/pose.h"
#include "runtime/scene/scene_options.h"

namespace kinora {

namespace {

constexpr double kCoarser = 1.25;  // from one try to the next where the limit binds
constexpr double kCoarsest = 1e7;  // pixels: nothing is split any more
constexpr size_t kNoLimit = ~size_t(0) / 2;

dvec3 point(std::span<const vec4> pose, const uint32_t corners[3], DicePoint at) {
    dvec3 sum(0.0);
    for (int k = 0; k < 3; ++k) sum += double(at.weight(k)) / kDiceOne * dvec3(pose[corners[k]]);
    return sum;
}

}  // namespace

Dicing::Dicing(const SceneOptions& options, std::span<const DisplacedMesh> meshes,
               const DiceViews& views, const std::atomic<bool>* stop)
    : options_(options), meshes_(meshes), views_(views), stop_(stop), parts_(meshes.size()) {}

void Dicing::run() {
    pixels_ = coarse_enough(std::max(options_.quality.dice, 1e-3));
    while (pixels_ < kCoarsest && !dice_to(pixels_, options_.dice_limit)) pixels_ *= kCoarser;
    if (pixels_ >= kCoarsest) dice_to(pixels_, kNoLimit);
    made_.clear();
    for (size_t m = 0; m < meshes_.size(); ++m) {
        const DisplacedMesh& mesh = meshes_[m];
        made_.push_back(diced_mesh(mesh.base, mesh.moved, parts_[m], mesh.deforms));
        parts_[m] = {};
    }
}

DiceStats Dicing::stats() const {
    DiceStats stats;
    stats.pixels = pixels_;
    for (size_t m = 0; m < meshes_.size(); ++m) {
        if (!meshes_[m].any_diced()) continue;
        stats.triangles += made_[m].triangles();
        stats.vertices += made_[m].mesh.positions.size();
    }
    return stats;
}

// `pixels`, or more where a coarse try tells that it would take more than twice the limit: fine
// tries that fail cost much more.
double Dicing::coarse_enough(double pixels) {
    constexpr double kProbe = 8;
    double limit = double(options_.dice_limit), base = 0, probed = 0;
    while (pixels < kCoarsest && !dice_to(kProbe * pixels, options_.dice_limit)) pixels *= kProbe;
    for (size_t m = 0; m < meshes_.size(); ++m) {
        if (!meshes_[m].any_diced() || parts_[m].triangles == 0) continue;
        for (const MeshGroup& group : meshes_[m].base.groups)
            base += double(group.triangles.size() / 3);
        probed += double(parts_[m].triangles);
    }
    double added = (probed - base) * kProbe * kProbe;
    for (; base + added > 2 * limit && pixels < kCoarsest; pixels *= kCoarser)
        added /= kCoarser * kCoarser;
    return pixels;
}

// False when all together come to more than `limit` triangles.
bool Dicing::dice_to(double pixels, size_t limit) {
    size_t used = 0;
    for (size_t m = 0; m < meshes_.size(); ++m) {
        bool counts = meshes_[m].any_diced();
        parts_[m] = {};
        std::optional<DicedParts> parts = dice_one(m, pixels, counts ? limit - used : kNoLimit);
        if (!parts) return false;
        parts_[m] = std::move(*parts);
        if (counts) used += parts_[m].triangles;
    }
    return true;
}

std::optional<DicedParts> Dicing::dice_one(size_t mesh, double pixels, size_t limit) const {
    const Mesh& base = meshes_[mesh].base;
    std::span<const DiceView> views = views_.of(mesh);
    auto longer = [&](const uint32_t corners[3], DicePoint a, DicePoint b, double times) {
        if (pixels >= kCoarsest || stopped()) return false;
        return std::any_of(views.begin(), views.end(), [&](const DiceView& view) {
            std::span<const vec4> pose = view.pose.empty() ? base.positions : view.pose;
            dvec3 from(view.accel_from_pose * dvec4(point(pose, corners, a), 1.0));
            dvec3 to(view.accel_from_pose * dvec4(point(pose, corners, b), 1.0));
            return edge_pixels(view.camera, from, to) > kLongestEdge * pixels * times;
        });
    };
    return dice_parts(base, meshes_[mesh].diced, longer, limit);
}

std::vector<std::unique_ptr<WatchedEdges>> Dicing::watch_edges(const SceneShapes& scene,
                                                               const Pose& start) const {
    std::vector<std::unique_ptr<WatchedEdges>> result(meshes_.size());
    size_t triangles = 0;
    for (size_t m = 0; m < meshes_.size(); ++m)
        if (meshes_[m].any_diced()) triangles += made_[m].triangles() * meshes_[m].shapes.size();
    for (size_t m = 0; m < meshes_.size(); ++m) {
        const DisplacedMesh& mesh = meshes_[m];
        if (!mesh.any_diced() || stopped()) continue;
        const Shape& first = scene.shapes[mesh.shapes[0]];
        auto watched = std::make_unique<WatchedEdges>();
        watched->shapes = mesh.shapes;
        watched->anchor = mesh.base.anchor;
        dmat3 world(start.nodes[first.node].world * first.conversion);
        choose_edges(mesh.base, made_[m], mesh.diced, world, mesh.deforms, triangles, *watched);
        result[m] = std::move(watched);
    }
    return result;
}

}  // namespace kinora
