// runtime/scene/build/displacement/displacement.cpp: meshes whose shaders move vertices: found,
// diced, and moved, once or ready to be at each frame.
#include "runtime/scene/build/displacement/displacement.h"

#include <algorithm>

#include "runtime/base/stats.h"
#include "runtime/scene/build/displacement/diced_shapes.h"
#include "runtime/scene/build/displacement/dicing.h"
#include "runtime/scene/build/shapes/pose_at.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/scene.h"
#include "runtime/scene/vertices/deform.h"

namespace kinora {

namespace {

// Dices, and keeps the result's figures and edges in the scene; the edges by mesh (null: none).
std::vector<WatchedEdges*> dice(Scene& scene, Dicing& dicing) {
    dicing.run();
    scene.dice = dicing.stats();
    scene.watched.clear();
    scene.start.watched.clear();
    std::vector<WatchedEdges*> by_mesh;
    for (std::unique_ptr<WatchedEdges>& edges : dicing.watch_edges(scene, scene.start)) {
        by_mesh.push_back(edges.get());
        if (!edges) continue;
        scene.watched.push_back(std::move(edges));
        scene.start.watched.emplace_back();
    }
    return by_mesh;
}

// Once, however often a scene is built again.
void report_limit(const Scene& scene, bool again, Diagnostics& diagnostics) {
    const SceneOptions& options = scene.options;
    auto reported = [](const Finding& finding) { return finding.info == &Code::DICE_LIMIT; };
    if (again && std::ranges::any_of(diagnostics.findings(), reported)) return;
    if (scene.dice.pixels > std::max(options.quality.dice, 1e-3))
        diagnostics.report(Code::DICE_LIMIT, Location{}, scene.dice.pixels, options.quality.dice,
                           options.dice_limit);
}

}  // namespace

void displace(Scene& scene, std::span<const SurfaceUse> uses, const CloserView* closer,
              const std::atomic<bool>* stop, Diagnostics& diagnostics) {
    std::vector<DisplacedMesh> meshes = find_displaced(scene, scene, scene);
    if (meshes.empty()) return;
    Stopwatch watch;
    DiceViews views(scene, meshes);
    Dicing dicing(scene.options, meshes, views, stop);
    bool any = std::ranges::any_of(meshes, &DisplacedMesh::any_diced);
    if (any) views.find(closer);
    std::vector<WatchedEdges*> watched = dice(scene, dicing);
    if (any && views.refine()) watched = dice(scene, dicing);
    report_limit(scene, closer != nullptr, diagnostics);
    for (size_t m = 0; m < meshes.size(); ++m) {
        const MeshUse& use = *uses[meshes[m].surfaces[0][0]].mesh;
        put_on_shapes(scene, meshes[m], dicing.made(m), use, watched[m], diagnostics);
    }
    size_outputs(scene, scene.start);
    bake_static(scene);
    pose_now(scene);
    scene.dice.ms = watch.ms();
}

}  // namespace kinora
