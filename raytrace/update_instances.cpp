// raytrace/update_instances.cpp: shapes shared by instances, and the instances' matrices.
#include <algorithm>
#include <cstring>

#include "raytrace/updater_p.h"

namespace kinora::raytrace {

void Updater::build_shape(InstancedShape& shape, bool dynamic) {
    const GeometryState& row = s.rows[shape.first_row];
    const Geometry& g = row.seen;
    shape.dynamic = dynamic;
    shape.scale = local_scale(s.size, size_of(g.positions));
    shape.scene = EmbreeScene(dynamic, s.policy.robust);
    if (!row.sound) return commit_shape(shape);  // empty
    watch(g);
    shape.kept = without_untraceable(g.positions, g.triangles, shape.scale);
    bool refit = dynamic && !s.policy.always_rebuild;
    // Rows of one shape may differ in mask and sides, so the instance carries the mask, and the
    // filter is there if any row might need it.
    bool filter = s.policy.fixed_winner || s.any_hidden_backfaces;
    shape.mesh =
        EmbreeMesh(g.positions, g.triangles, refit ? BuildQuality::Refit : BuildQuality::Medium,
                   kMaskAll, filter, shape.scale);
    shape.scene.attach(shape.mesh, 0);
    commit_shape(shape);
    ++s.report.rebuilds;
}

// Alone in its scene, a mesh may have triangles that are not traceable.
void Updater::commit_shape(InstancedShape& shape) {
    shape.scene.commit();
    shape.scene.bounds(shape.low, shape.high);
}

void Updater::add_instanced(uint32_t index) {
    GeometryState& row = s.rows[index];
    row.slot = uint32_t(s.map.slots.size());
    s.map.slots.push_back({nullptr, index, row.seen.hide_backfaces});
    if (!row.sound) return;
    auto known = shape_of_.find(row.seen.shape);
    if (known != shape_of_.end()) {
        row.shape = known->second;
    } else {
        row.shape = uint32_t(s.shapes.size());
        if (row.seen.shape != kNone) shape_of_[row.seen.shape] = row.shape;
        s.shapes.emplace_back().first_row = index;
        build_shape(s.shapes.back(), false);
    }
    update_instance(index, row.seen, true);
}

// The first row of a shape speaks for it. Returns whether its tree changed.
bool Updater::update_shape(uint32_t index, const Geometry& now) {
    GeometryState& row = s.rows[index];
    if (row.shape == kNone || s.shapes[row.shape].first_row != index) return false;
    InstancedShape& shape = s.shapes[row.shape];
    const bool same = same_buffers(row.seen, now);
    if (same && row.seen.positions_version == now.positions_version) return false;
    dmat4 matrix = row.seen.accel_from_local;  // compared by update_instance
    row.seen = now;
    row.seen.accel_from_local = matrix;
    if (!same) row.sound = sound(now);
    if (same && !row.sound) return false;
    // Embree leaves bad triangles out of a tree for good.
    if (!same || !shape.dynamic ||
        shape.kept != without_untraceable(now.positions, now.triangles, shape.scale)) {
        build_shape(shape, same);
        // Instances hold on to the scene they were made of.
        for (GeometryState& r : s.rows)
            if (r.shape == row.shape) leave_out(r);
    } else {
        shape.mesh.vertices_moved();
        commit_shape(shape);
        ++(s.policy.always_rebuild ? s.report.rebuilds : s.report.refits);
    }
    return true;
}

void Updater::leave_out(GeometryState& row) {
    if (row.attached) s.top.detach(row.slot);
    row.attached = false;
}

// Returns whether the instance is traceable where its matrix puts it.
bool Updater::place(GeometryState& row) {
    if (!make_placement(row.seen.accel_from_local, s.scale, s.shapes[row.shape].scale,
                        row.placement)) {
        note(GeometryIssue::SingularMatrix, row.seen.id, 1);
        return false;
    }
    const InstancedShape& shape = s.shapes[row.shape];
    if (!has_extent(shape.low, shape.high)) return false;
    if (!row.attached) row.instance = EmbreeInstance(shape.scene, mask_of(row.seen));
    row.instance.set_matrix(row.placement.traced);
    return surely_has_extent(row.placement, shape.low, shape.high) || row.instance.has_extent();
}

bool Updater::update_instance(uint32_t index, const Geometry& now, bool shape_changed) {
    GeometryState& row = s.rows[index];
    if (row.shape == kNone) return false;
    const bool moved =
        std::memcmp(&row.seen.accel_from_local, &now.accel_from_local, sizeof(dmat4)) != 0;
    row.seen = now;
    if (!moved && !shape_changed) return false;
    s.report.matrices += moved;
    if (!place(row)) {
        leave_out(row);
        return true;
    }
    if (!row.attached) s.top.attach(row.instance, row.slot);
    row.attached = true;
    map_row(index);
    return true;
}

float Updater::least_limit(std::span<const uint32_t> rows) const {
    float least = kLargest;
    for (uint32_t i : rows) {
        const GeometryState& row = s.rows[i];
        if (row.seen.kind == GeometryKind::Instanced && row.attached)
            least = std::min(least, row.placement.largest_origin);
    }
    return least;
}

void Updater::limit_origins() {
    s.largest_origin = kLargest;
    for (const GeometryState& row : s.rows)
        if (row.seen.kind == GeometryKind::Instanced && row.attached)
            s.largest_origin = std::min(s.largest_origin, row.placement.largest_origin);
}

// After these rows alone have changed. All are looked at only where one of them had the least and
// has more now.
void Updater::limit_origins(std::span<const uint32_t> rows, float least_before) {
    const float least = least_limit(rows);
    if (least > s.largest_origin && least_before <= s.largest_origin) return limit_origins();
    s.largest_origin = std::min(s.largest_origin, least);
}

}  // namespace kinora::raytrace
