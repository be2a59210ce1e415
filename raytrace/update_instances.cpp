// raytrace/update_instances.cpp: shapes shared by instances, and the instances' matrices.
#include <algorithm>
#include <cstring>

#include "raytrace/updater_p.h"

namespace kinora::raytrace {

void Updater::build_shape(InstancedShape& shape, bool dynamic) {
    const GeometryState& row = s.rows[shape.first_row];
    const Geometry& g = row.seen;
    shape.dynamic = dynamic;
    const float scale = local_scale(s.size, size_of(g.positions));
    // Rows of one shape may differ in mask and sides, so the instance carries the mask, and the
    // filter is there if any row might need it.
    const bool filtered = s.policy.fixed_winner || s.any_hidden_backfaces;
    const ShapeSource source{g.positions, g.triangles, scale, s.policy.robust, filtered};
    if (row.sound) watch(g);
    const bool keeps = s.policy.kept && row.sound && !dynamic;
    if (keeps && (shape.tree = s.policy.kept->state().find(source))) {
        ++s.report.kept;
        return;
    }
    shape.tree = std::make_shared<ShapeTree>();
    ShapeTree& tree = *shape.tree;
    tree.scale = scale;
    tree.scene = EmbreeScene(dynamic, s.policy.robust);
    if (!row.sound) return commit_tree(tree);  // empty
    const bool refit = dynamic && !s.policy.always_rebuild;
    fill_tree(tree, source, refit ? BuildQuality::Refit : BuildQuality::Medium, keeps);
    if (keeps) s.policy.kept->state().keep(source, shape.tree);
    ++s.report.rebuilds;
}

// A tree that is kept reads buffers of its own.
void Updater::fill_tree(ShapeTree& tree, const ShapeSource& source, BuildQuality quality,
                        bool keeps) {
    std::span<const vec4> positions = source.positions;
    std::span<const uint32_t> triangles = source.triangles;
    if (keeps) {
        tree.positions.assign(positions.begin(), positions.end());
        tree.triangles.assign(triangles.begin(), triangles.end());
        positions = tree.positions, triangles = tree.triangles;
    }
    tree.kept = without_untraceable(positions, triangles, tree.scale);
    tree.mesh = EmbreeMesh(positions, triangles, quality, kMaskAll, source.filtered, tree.scale);
    tree.scene.attach(tree.mesh, 0);
    commit_tree(tree);
}

// Alone in its scene, a mesh may have triangles that are not traceable.
void Updater::commit_tree(ShapeTree& tree) {
    tree.scene.commit();
    tree.scene.bounds(tree.low, tree.high);
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
        shape.tree->kept != without_untraceable(now.positions, now.triangles, shape.tree->scale)) {
        build_shape(shape, same);
        // Instances hold on to the scene they were made of.
        for (GeometryState& r : s.rows)
            if (r.shape == row.shape) leave_out(r);
    } else {
        shape.tree->mesh.vertices_moved();
        commit_tree(*shape.tree);
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
    const ShapeTree& tree = *s.shapes[row.shape].tree;
    if (!make_placement(row.seen.accel_from_local, s.scale, tree.scale, row.placement)) {
        note(GeometryIssue::SingularMatrix, row.seen.id, 1);
        return false;
    }
    if (!has_extent(tree.low, tree.high)) return false;
    if (!row.attached) row.instance = EmbreeInstance(tree.scene, mask_of(row.seen));
    row.instance.set_matrix(row.placement.traced);
    return surely_has_extent(row.placement, tree.low, tree.high) || row.instance.has_extent();
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
