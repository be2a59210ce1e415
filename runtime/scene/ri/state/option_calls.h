// runtime/scene/ri/state/option_calls.h: requests of the camera and the picture.
#pragma once

#include "runtime/scene/ri/state/shader_calls.h"
#include "runtime/scene/ri/state/state.h"

namespace kinora::ri {

class OptionCalls {
  public:
    OptionCalls(State& state, StateReport& report, ShaderCalls& shaders)
        : state_(state), report_(report), shaders_(shaders) {}

    // False: the request is none of these.
    bool call(const Call& call);

  private:
    void format(const Call& call);
    void frame_aspect_ratio(const Call& call);
    void screen_window(const Call& call);
    void crop_window(const Call& call);
    void projection(const Call& call);
    void clipping(const Call& call);
    void clipping_plane(const Call& call);
    void depth_of_field(const Call& call);
    void shutter(const Call& call);
    void pixel_samples(const Call& call);
    void pixel_filter(const Call& call);
    void exposure(const Call& call);
    void imager(const Call& call);
    void quantize(const Call& call);
    void display(const Call& call);
    void hider(const Call& call);
    void color_samples(const Call& call);
    void relative_detail(const Call& call);
    void option(const Call& call);

    State& state_;
    StateReport& report_;
    ShaderCalls& shaders_;
};

}  // namespace kinora::ri
