// runtime/picture/shading/lighting/area_light.h: lights on geometry: where on it each lit point
// looks.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "raytrace/accel.h"
#include "raytrace/random/series.h"
#include "runtime/picture/lights/light_bindings.h"
#include "runtime/picture/shading/grid.h"
#include "runtime/picture/shading/lighting/lit_points.h"

namespace kinora {

// One sample of an area light for each of a number of lit points.
struct LightSamples {
    // For the points of `grid` from `first` on, yet to be chosen; what a light kernel's services
    // may read of a hit is 0.
    LightSamples(const Grid& grid, size_t first, size_t count, uint32_t surface);

    raytrace::HitBatch hits;
    std::span<uint32_t> instance, primitive;
    float *u, *v;
    raytrace::Accel::SurfacePoints on_surface;
};

// One of the samples that a light has at a point.
struct SampleNumber {
    uint32_t number, of;
};

// A light on geometry: its triangles by area.
struct AreaLight {
    uint32_t surface = kNone;
    bool directed = false;     // else its light comes from no point of it
    std::vector<float> below;  // area of the triangles up to each, summed
    bool known = false;
    bool has_area() const { return !below.empty() && below.back() > 0; }
};

// Samples of lights that have an extent: of those on geometry and of solar with an angle. Where
// neither the option nor the file says how many, a surface with rays of indirect light takes fewer,
// as these bring the more noise.
uint32_t light_samples(const ShadingFrame& frame, size_t light, bool beside_indirect);

class AreaLights {
  public:
    AreaLights(const ShadingFrame& frame, const LightBindings& bindings);
    // Areas once, and again in each frame where the mesh may deform or be scaled.
    void begin_frame();
    // Light `light` among Scene::lights; null where it is none on geometry.
    const AreaLight* find(size_t light) const { return lights_[light].get(); }
    bool any() const { return any_; }
    // A sample of the light at each point; `lit` is the grid that its kernel runs on.
    void choose(const Grid& lit, const LightPoints& at, const AreaLight& light, SampleNumber sample,
                LightSamples& samples) const;

  private:
    const ShadingFrame& frame_;
    std::vector<std::unique_ptr<AreaLight>> lights_;
    bool any_ = false;
};

}  // namespace kinora
