// runtime/picture/shading/frame/frame.cpp: the parts of a scene as shading reads them, and sums.
#include "runtime/picture/shading/frame/frame.h"

#include "runtime/scene/scene.h"

namespace kinora {

void ShadingCounters::operator+=(const ShadingCounters& o) {
    trace += o.trace;
    points += o.points;
    light_points += o.light_points;
    opacity_points += o.opacity_points;
    columns += o.columns;
    too_deep += o.too_deep;
    unlit += o.unlit;
    out_of_rays += o.out_of_rays;
    thinned += o.thinned;
    kernel_points += o.kernel_points;
    kernel_lanes += o.kernel_lanes;
    seen += o.seen;
    dark += o.dark;
}

ShadingFrame::ShadingFrame(const Scene& s, const Pose& p)
    : scene(s),
      resources(s),
      nodes(s),
      shapes(s),
      lights(s),
      shaders(s),
      quality(s.options.quality),
      pose(p),
      bounces(s.shader_instances.size(), s.options.quality.diffuse_depth) {
    for (const LightSource& light : s.lights)
        if (s.description->lights[light.definition].indirect && s.options.indirect > 0)
            bounces[light.look] = s.options.indirect;
}

}  // namespace kinora
