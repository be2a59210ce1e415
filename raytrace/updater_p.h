// raytrace/updater_p.h: the steps of one Accel::update.
#pragma once

#include <map>
#include <vector>

#include "raytrace/accel_state_p.h"
#include "raytrace/traceable_p.h"

namespace kinora::raytrace {

inline uint32_t mask_of(const Geometry& g) {
    return (mask_of_viewer(g.seen_by) & (g.opaque ? kMaskOpaque : kMaskNotOpaque)) |
           (g.seen_by & kMaskLamp);
}

inline bool same_buffers(const Geometry& a, const Geometry& b) {
    return a.positions.data() == b.positions.data() && a.positions.size() == b.positions.size() &&
           a.triangles.data() == b.triangles.data() && a.triangles.size() == b.triangles.size() &&
           a.topology_version == b.topology_version;
}

// The steps of one update. A class only to share the names of the state's parts.
class Updater {
  public:
    explicit Updater(Accel::State& state) : s(state) {}
    void run(std::span<const Geometry> geometry, std::span<const uint32_t> rows);

  private:
    bool must_start_anew(std::span<const Geometry> geometry, std::span<const uint32_t> rows) const;
    void update_rows(std::span<const Geometry> geometry, std::span<const uint32_t> rows);
    void start_anew(std::span<const Geometry> geometry);
    void add_static_groups();
    void add_deforming(uint32_t row);
    bool has_first_pose(const GeometryState& row) const;
    void leave_first_poses();
    void add_instanced(uint32_t row);
    void build_shape(InstancedShape& shape, bool dynamic);
    void fill_tree(ShapeTree& tree, const ShapeSource& source, BuildQuality quality, bool keeps);
    void commit_tree(ShapeTree& tree);
    bool place(GeometryState& row);
    void leave_out(GeometryState& row);
    void map_row(uint32_t row);
    bool sound(const Geometry& g);
    void note(GeometryIssue issue, uint32_t id, uint32_t count);
    BoxAreas watch(const Geometry& g);
    float largest_vertex(const Geometry& g) const;

    bool find_traceable(GeometryState& row);
    bool update_deforming(uint32_t row, const Geometry& now);
    bool build_deforming(GeometryState& row);
    void refit_or_rebuild(GeometryState& row);
    void rebuild(GeometryState& row, BuildQuality quality, double area);
    void rebuild_low(GeometryState& row, double area);
    bool update_shape(uint32_t row, const Geometry& now);
    bool update_instance(uint32_t row, const Geometry& now, bool shape_changed);

    void limit_origins();
    void limit_origins(std::span<const uint32_t> rows, float least_before);
    float least_limit(std::span<const uint32_t> rows) const;
    void start_background();
    void take_up_background();
    bool filtered(const Geometry& g) const { return s.policy.fixed_winner || g.hide_backfaces; }
    BuildQuality deforming_quality() const {
        return s.policy.always_rebuild ? BuildQuality::Medium : BuildQuality::Refit;
    }

    Accel::State& s;
    std::map<uint32_t, uint32_t> shape_of_;  // Geometry::shape -> index in AccelState::shapes
    std::vector<uint32_t> in_first_pose_;    // rows whose trees are built from another pose
    bool want_background_ = false;
};

}  // namespace kinora::raytrace
