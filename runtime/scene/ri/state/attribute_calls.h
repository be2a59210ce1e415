// runtime/scene/ri/state/attribute_calls.h: attributes of shading and geometry but for shaders.
#pragma once

#include "runtime/scene/ri/state/state.h"

namespace kinora::ri {

class AttributeCalls {
  public:
    AttributeCalls(State& state, StateReport& report) : state_(state), report_(report) {}

    // False: the request is none of these.
    bool call(const Call& call);

  private:
    void color(const Call& call);
    void opacity(const Call& call);
    void texture_coordinates(const Call& call);
    void shading_rate(const Call& call);
    void matte(const Call& call);
    void attribute(const Call& call);
    void judge_word(std::string_view group, const Parameter& parameter);
    void detail(const Call& call);
    void detail_range(const Call& call);
    void orientation(const Call& call);
    void reverse_orientation(const Call& call);
    void sides(const Call& call);
    void basis(const Call& call);
    void trim_curve(const Call& call);

    State& state_;
    StateReport& report_;
};

}  // namespace kinora::ri
