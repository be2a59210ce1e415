// runtime/scene/build/added_camera_p.h: a camera that no file brought, while it is made.
#pragma once

#include <initializer_list>
#include <span>
#include <vector>

#include "anim/sampler.h"
#include "runtime/scene/build/added_camera.h"
#include "runtime/scene/build/core.h"
#include "runtime/scene/build/shapes/shown_vertices.h"
#include "runtime/scene/scene.h"

namespace kinora {

// Keys for numbers of a node that is being added.
struct Motion {
    uint32_t slot = kNone;  // in SceneDescription::values
    std::vector<double> times, values;
    anim::Behaviour beyond = anim::Behaviour::Constant;
};

// Where a camera stands, relative to `origin`, which may move.
struct Stand {
    ViewAxes axes;
    dvec3 eye{0.0};
    double half_height = 0;  // of parallel rays; 0: perspective
    double reach = 0;        // how far from `origin` what it frames is
};

// A stand, and the largest share of its picture that the scene takes, as far as kLittle.
struct JudgedStand {
    Stand stand;
    double share = 0;
};

class AddedCamera {
  public:
    AddedCamera(Scene& scene, NodeTree& tree, const ViewWord& view)
        : scene_(scene),
          tree_(tree),
          options_(scene.options.view),
          view_(view),
          frame_(up_axis_frame(scene.description->up_axis)),
          vertices_(scene, scene.start) {}

    bool choose_subject(Diagnostics& diagnostics);
    void add(Diagnostics& diagnostics);

  private:
    // added_camera.cpp
    void find_path();
    dvec3 origin(size_t time) const;
    Stand stand() const;
    uint32_t append(std::initializer_list<double> numbers);
    ValueSlot slot(double number) { return {append({number}), 1}; }
    NodeDefinition node(const Stand& stand);
    CameraDefinition camera(const Stand& stand);
    void animate(uint32_t node);

    // added_camera_frame.cpp
    // What of the subject is framed: at each time what lies together then, or what comes near to a
    // place over the range (about the origin); else all.
    struct Part {
        bool core_of_each = false;
        Core near;
    };
    bool parallel() const { return view_.parallel && options_.yfov == 0 && !options_.from; }
    bool turns() const { return options_.turn_seconds > 0; }
    double half_height() const;  // at distance 1
    std::span<const dvec3> subject_now(bool still);
    Stand frame(int side, const Part& part);
    Stand frame(Diagnostics& diagnostics);
    double covered_at(const Stand& stand, size_t time);
    JudgedStand judged(const Stand& stand);
    bool shows_often(const Stand& stand);
    bool leave_strays_out(JudgedStand& best);
    bool stay_with_most(JudgedStand& best, Diagnostics& diagnostics);
    void report_farthest(const FindingInfo& code, dvec3 middle, Diagnostics& diagnostics);

    Scene& scene_;
    NodeTree& tree_;
    const ViewOptions& options_;
    const ViewWord& view_;
    ViewAxes frame_;
    ShownVertices vertices_;
    uint32_t at_node_ = kNone;
    std::vector<uint32_t> subject_;  // shapes
    std::vector<dvec3> points_;
    std::vector<double> times_;
    std::vector<dvec3> path_;  // the subject's centre at these times; empty: not asked for
    dvec3 base_{0.0};          // of the origin at the first time
    std::vector<Motion> motions_;
};

}  // namespace kinora
