// raytrace/accel_update.cpp: keeps the trees fit: what changed is refitted, what grew is rebuilt.
#include <algorithm>
#include <cmath>
#include <utility>

#include "raytrace/updater_p.h"

namespace kinora::raytrace {

namespace {

// LOW rebuilds in a row without growth after which a mesh is built well and refitted again.
constexpr int kCalmUpdates = 4;

bool same_role(const Geometry& a, const Geometry& b) {
    return a.id == b.id && a.kind == b.kind && a.opaque == b.opaque && a.shape == b.shape &&
           a.seen_by == b.seen_by && a.hide_backfaces == b.hide_backfaces &&
           a.mirrored == b.mirrored;
}

}  // namespace

void Updater::note(GeometryIssue issue, uint32_t id, uint32_t count) {
    s.report.issues.push_back({issue, id, count});
}

// Embree drops what lies farther off in its own space.
float Updater::largest_vertex(const Geometry& g) const {
    return g.kind == GeometryKind::Instanced ? kLargest : kLargest / std::max(s.scale, 1.0f);
}

BoxAreas Updater::watch(const Geometry& g) {
    BoxAreas areas = box_areas(g.positions, g.triangles, largest_vertex(g), s.partial);
    if (areas.bad_triangles > 0) note(GeometryIssue::BadVertices, g.id, areas.bad_triangles);
    return areas;
}

bool Updater::sound(const Geometry& g) {
    if (g.triangles.size() < 3 || g.positions.empty()) return false;  // nothing to hit
    uint32_t bad = count_bad_indices(g.positions.size(), g.triangles);
    if (bad > 0) note(GeometryIssue::IndexOutOfRange, g.id, bad);
    return bad == 0;
}

bool Updater::must_start_anew(std::span<const Geometry> geometry,
                              std::span<const uint32_t> rows) const {
    if (!s.top || geometry.size() != s.rows.size()) return true;
    for (uint32_t i : rows) {
        const Geometry& seen = s.rows[i].seen;
        if (!same_role(seen, geometry[i])) return true;
        if (seen.kind == GeometryKind::Static &&
            (!same_buffers(seen, geometry[i]) ||
             seen.positions_version != geometry[i].positions_version))
            return true;
    }
    return false;
}

void Updater::map_row(uint32_t row) {
    const GeometryState& r = s.rows[row];
    HitMap::Row& m = s.map.rows[row];
    m.id = r.seen.id;
    m.body = r.seen.body == kNone ? row : r.seen.body;
    m.mirrored = r.seen.mirrored;
    m.instanced = r.seen.kind == GeometryKind::Instanced;
    std::copy_n(r.placement.normal, 9, m.normal);
}

void Updater::start_anew(std::span<const Geometry> geometry) {
    s.background.reset();
    s.top = EmbreeScene(true, s.policy.robust);
    s.rows.clear();
    s.groups.clear();
    s.shapes.clear();
    if (s.policy.kept) s.policy.kept->state().begin();
    s.map.slots.clear();
    s.map.rows.assign(geometry.size(), {});
    s.rows.resize(geometry.size());
    for (size_t i = 0; i < geometry.size(); ++i) {
        s.rows[i].seen = geometry[i];
        s.rows[i].sound = sound(geometry[i]);
        s.any_hidden_backfaces |= geometry[i].hide_backfaces;
    }
    s.size = size_of(geometry);
    s.scale = top_scale(s.size);
    add_static_groups();
    for (uint32_t i = 0; i < geometry.size(); ++i) {
        if (geometry[i].kind == GeometryKind::Deforming) add_deforming(i);
        if (geometry[i].kind == GeometryKind::Instanced) add_instanced(i);
        map_row(i);
    }
    limit_origins();
    s.top.commit();
    if (in_first_pose_.empty()) return;
    leave_first_poses();
    s.top.commit();
}

void Updater::add_static_groups() {
    std::map<std::pair<uint32_t, bool>, StaticGroup*> groups;
    std::map<std::pair<const StaticGroup*, const vec4*>, uint32_t> bases;
    for (uint32_t i = 0; i < s.rows.size(); ++i) {
        const GeometryState& row = s.rows[i];
        const Geometry& g = row.seen;
        if (g.kind != GeometryKind::Static || !row.sound) continue;
        watch(g);
        StaticGroup*& group = groups[{mask_of(g), g.hide_backfaces}];
        if (!group) {
            group = s.groups.emplace_back(std::make_unique<StaticGroup>()).get();
            group->slot = uint32_t(s.map.slots.size());
            s.map.slots.push_back({nullptr, i, g.hide_backfaces});
        }
        s.map.rows[i].first_primitive = uint32_t(group->owner.size());
        // Rows of one mesh share its positions.
        auto [known, is_new] =
            bases.try_emplace({group, g.positions.data()}, uint32_t(group->positions.size()));
        const uint32_t base = known->second;
        if (is_new)
            group->positions.insert(group->positions.end(), g.positions.begin(), g.positions.end());
        const size_t corners = g.triangles.size() / 3 * 3;
        const std::vector<uint32_t> kept = without_untraceable(g.positions, g.triangles, s.scale);
        const std::span<const uint32_t> triangles = kept.empty() ? g.triangles : kept;
        for (size_t k = 0; k < corners; ++k)
            group->triangles.push_back(triangles[k] == kNone ? kNone : base + triangles[k]);
        group->owner.insert(group->owner.end(), corners / 3, i);
    }
    for (auto& group : s.groups) {
        const Geometry& g = s.rows[group->owner.front()].seen;
        group->mesh = EmbreeMesh(group->positions, group->triangles, BuildQuality::Medium,
                                 mask_of(g), filtered(g), s.scale);
        s.map.slots[group->slot].owner = group->owner.data();
        s.top.attach(group->mesh, group->slot);
        ++s.report.rebuilds;
    }
}

void Updater::add_deforming(uint32_t index) {
    GeometryState& row = s.rows[index];
    row.slot = uint32_t(s.map.slots.size());
    s.map.slots.push_back({nullptr, index, row.seen.hide_backfaces});
    if (row.sound) row.edges = shared_edges(row.seen.triangles);
    find_traceable(row);
    if (!build_deforming(row) || !has_first_pose(row)) return;
    row.mesh.vertices_moved_to(row.seen.built_from);
    in_first_pose_.push_back(index);
}

// Triangles that a tree is built without would never come back, so all must be traceable in both.
bool Updater::has_first_pose(const GeometryState& row) const {
    const Geometry& g = row.seen;
    return deforming_quality() == BuildQuality::Refit && row.kept.empty() &&
           g.built_from.size() == g.positions.size() &&
           without_untraceable(g.built_from, g.triangles, s.scale).empty();
}

void Updater::leave_first_poses() {
    for (uint32_t i : in_first_pose_) s.rows[i].mesh.vertices_moved_to(s.rows[i].seen.positions);
    in_first_pose_.clear();
}

// Replaces the row's mesh: a new one is the only way to another quality, and the sure way to a tree
// built from the vertices as they are.
void Updater::rebuild(GeometryState& row, BuildQuality quality, double area) {
    const Geometry& g = row.seen;
    if (row.attached) s.top.detach(row.slot);
    row.mesh = EmbreeMesh(g.positions, row.triangles(), quality, mask_of(g), filtered(g), s.scale);
    s.top.attach(row.mesh, row.slot);
    row.attached = true;
    row.quality = quality;
    row.area_at_build = area;
    row.calm_updates = 0;
    ++(quality == BuildQuality::Low ? s.report.low_rebuilds : s.report.rebuilds);
}

// Returns whether other triangles are traceable than before, for which a tree must be built.
bool Updater::find_traceable(GeometryState& row) {
    if (!row.sound) return false;
    std::vector<uint32_t> kept =
        without_untraceable(row.seen.positions, row.seen.triangles, s.scale, row.edges);
    if (kept == row.kept) return false;
    s.background.reset();  // it reads the old ones
    row.kept = std::move(kept);
    return true;
}

// Builds the row's tree of its traceable triangles. Returns false if there is none, so that the row
// is left out.
bool Updater::build_deforming(GeometryState& row) {
    const double area = row.sound ? watch(row.seen).sum : 0;
    const bool traced = row.sound && (row.kept.empty() || any_traceable(row.kept));
    if (traced) {
        rebuild(row, deforming_quality(), area);
    } else if (row.attached) {
        s.top.detach(row.slot);
        row.attached = false;
    }
    return traced;
}

bool Updater::update_deforming(uint32_t index, const Geometry& now) {
    GeometryState& row = s.rows[index];
    const bool same = same_buffers(row.seen, now);
    if (same && row.seen.positions_version == now.positions_version) return false;
    row.seen = now;
    if (!same) {
        s.background.reset();  // it is made of the old triangles
        row.sound = sound(now);
        row.edges = row.sound ? shared_edges(now.triangles) : std::vector<uint32_t>();
    }
    if (find_traceable(row) || !same) {
        build_deforming(row);
        return true;
    }
    if (row.attached) refit_or_rebuild(row);
    return row.attached;
}

void Updater::refit_or_rebuild(GeometryState& row) {
    if (row.quality == BuildQuality::Medium) {  // always_rebuild
        watch(row.seen);
        row.mesh.vertices_moved();
        ++s.report.rebuilds;
        return;
    }
    const double area = watch(row.seen).sum;
    const double growth = row.area_at_build > 0 ? area / row.area_at_build : (area > 0 ? 1e9 : 1);
    s.report.largest_growth = std::max(s.report.largest_growth, float(growth));
    if (row.quality == BuildQuality::Low) return rebuild_low(row, area);
    if (growth > double(s.policy.low_limit)) {
        rebuild(row, BuildQuality::Low, area);
        want_background_ = s.policy.background;
    } else if (growth > double(s.policy.refit_limit) && !s.policy.background) {
        rebuild(row, BuildQuality::Refit, area);
    } else {
        row.mesh.vertices_moved();
        ++s.report.refits;
        want_background_ |= growth > double(s.policy.refit_limit);
    }
}

// The mesh grew past low_limit before: LOW at each update, until it has been calm for a while.
void Updater::rebuild_low(GeometryState& row, double area) {
    const double limit = double(s.policy.refit_limit);
    const bool calm = area < limit * row.area_at_build && row.area_at_build < limit * area;
    const int calm_updates = calm ? row.calm_updates + 1 : 0;
    if (calm_updates >= kCalmUpdates && !s.policy.background)
        return rebuild(row, BuildQuality::Refit, area);
    row.mesh.vertices_moved();
    row.area_at_build = area;
    row.calm_updates = calm_updates;
    want_background_ |= calm_updates >= kCalmUpdates;
    ++s.report.low_rebuilds;
}

void Updater::update_rows(std::span<const Geometry> geometry, std::span<const uint32_t> rows) {
    bool changed = s.report.background_finished > 0;
    const float least = least_limit(rows);
    for (uint32_t i : rows)
        if (geometry[i].kind == GeometryKind::Deforming)
            changed |= update_deforming(i, geometry[i]);
    s.shape_changed.resize(s.shapes.size());
    for (uint32_t i : rows)
        if (uint32_t shape = s.rows[i].shape; shape != kNone) s.shape_changed[shape] = 0;
    for (uint32_t i : rows)
        if (update_shape(i, geometry[i])) s.shape_changed[s.rows[i].shape] = 1;
    for (uint32_t i : rows)
        if (geometry[i].kind == GeometryKind::Instanced && s.rows[i].shape != kNone)
            changed |= update_instance(i, geometry[i], s.shape_changed[s.rows[i].shape] != 0);
    if (!changed) return;
    limit_origins(rows, least);
    s.top.commit();
}

void Updater::run(std::span<const Geometry> geometry, std::span<const uint32_t> rows) {
    s.report.compared = rows.size();
    if (must_start_anew(geometry, rows)) return start_anew(geometry);
    take_up_background();
    update_rows(geometry, rows);
    if (want_background_) start_background();
}

Accel::Accel(const AccelPolicy& policy) : state_(std::make_shared<State>()) {
    state_->policy = policy;
}
Accel::~Accel() = default;
Accel::Accel(Accel&&) noexcept = default;
Accel& Accel::operator=(Accel&&) noexcept = default;

Accel Accel::shared() const {
    Accel same(state_->policy);
    same.state_ = state_;
    return same;
}

const AccelUpdate& Accel::last_update() const {
    return state_->report;
}

const AccelUpdate& Accel::update(std::span<const Geometry> geometry) {
    std::vector<uint32_t>& all = state_->all_rows;
    for (uint32_t i = uint32_t(all.size()); i < geometry.size(); ++i) all.push_back(i);
    return update(geometry, std::span(all).first(geometry.size()));
}

const AccelUpdate& Accel::update(std::span<const Geometry> geometry,
                                 std::span<const uint32_t> rows) {
    std::vector<AccelUpdate::Issue> issues = std::move(state_->report.issues);
    issues.clear();
    state_->report = {};
    state_->report.issues = std::move(issues);
    Updater(*state_).run(geometry, rows);
    return state_->report;
}

}  // namespace kinora::raytrace
