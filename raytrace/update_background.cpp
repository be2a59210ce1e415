// raytrace/update_background.cpp: the second tree, built while the first one serves.
#include <new>
#include <utility>

#include "raytrace/updater_p.h"

namespace kinora::raytrace {

void Updater::start_background() {
    if (s.background) return;
    s.background = std::make_unique<BackgroundBuild>();
    BackgroundBuild& build = *s.background;
    build.scene = EmbreeScene(true, s.policy.robust);
    for (auto& group : s.groups) build.scene.attach(group->mesh, group->slot);
    for (uint32_t i = 0; i < s.rows.size(); ++i) {
        GeometryState& row = s.rows[i];
        const Geometry& g = row.seen;
        if (g.kind != GeometryKind::Deforming || !row.attached) continue;
        auto& copy = build.copies.emplace_back();
        copy.row = i;
        copy.area = box_areas(g.positions, g.triangles, largest_vertex(g), s.partial).sum;
        copy.positions.assign(g.positions.begin(), g.positions.end());
        copy.mesh = EmbreeMesh(copy.positions, row.triangles(), BuildQuality::Refit, mask_of(g),
                               filtered(g), s.scale);
        build.scene.attach(copy.mesh, row.slot);
    }
    build.thread = std::thread([&build] {
        try {
            build.scene.commit();
        } catch (const std::exception&) {  // none may leave a thread; the tree in use serves on
            build.failed = true;
        }
        build.done.store(true, std::memory_order_release);
    });
    ++s.report.background_started;
}

// The rows' current vertices go into the finished tree by one refit.
void Updater::take_up_background() {
    if (!s.background || !s.background->done.load(std::memory_order_acquire)) return;
    BackgroundBuild& build = *s.background;
    build.thread.join();
    if (build.failed) return s.background.reset();  // the tree in use serves on
    for (auto& copy : build.copies) {
        GeometryState& row = s.rows[copy.row];
        copy.mesh.vertices_moved_to(row.seen.positions);
        row.mesh = std::move(copy.mesh);
        row.quality = BuildQuality::Refit;
        row.area_at_build = copy.area;
        row.calm_updates = 0;
    }
    for (GeometryState& row : s.rows)
        if (row.seen.kind == GeometryKind::Instanced && row.attached)
            build.scene.attach(row.instance, row.slot);
    s.top = std::move(build.scene);
    s.background.reset();
    ++s.report.background_finished;
}

void Accel::wait_for_background() {
    if (!state_->background) return;
    while (!state_->background->done.load(std::memory_order_acquire)) std::this_thread::yield();
}

}  // namespace kinora::raytrace
