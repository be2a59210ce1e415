// runtime/scene/ri/state/transform_calls.h: the current transformation and named spaces.
#pragma once

#include "runtime/scene/ri/state/state.h"

namespace kinora::ri {

class TransformCalls {
  public:
    TransformCalls(State& state, StateReport& report) : state_(state), report_(report) {}

    // False: the request is none of these.
    bool call(const Call& call);
    // From a space that the interface or the file names, to the camera. Nothing: it is not known.
    std::optional<dmat4> camera_from(std::string_view space) const;
    // RiTransformPoints.
    bool transform_points(std::string_view from, std::string_view to, std::span<float> points);

  private:
    void identity(const Call& call);
    void transform(const Call& call);
    void concat_transform(const Call& call);
    void perspective(const Call& call);
    void translate(const Call& call);
    void rotate(const Call& call);
    void scale(const Call& call);
    void skew(const Call& call);
    void coordinate_system(const Call& call);
    void scoped_coordinate_system(const Call& call);
    void coord_sys_transform(const Call& call);
    void set(const dmat4& matrix);
    void concat(const dmat4& matrix);
    dvec4 at_unit_distance(dvec4 p, bool back) const;

    State& state_;
    StateReport& report_;
};

}  // namespace kinora::ri
