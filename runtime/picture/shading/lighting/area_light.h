// runtime/picture/shading/lighting/area_light.h: lights on geometry: their triangles and shapes.
#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

#include "raytrace/accel.h"
#include "raytrace/random/series.h"
#include "runtime/picture/lights/lamp_shape.h"
#include "runtime/picture/lights/light_bindings.h"
#include "runtime/picture/shading/grid.h"
#include "runtime/picture/shading/lighting/lit_points.h"

namespace kinora {

// One sample of an area light for each of a number of lit points.
struct LightSamples {
    // Yet to be chosen; what a light kernel's services may read of a hit is 0.
    LightSamples(Arena& arena, size_t count, uint32_t surface);
    // For the points of `grid` from `first` on.
    LightSamples(const Grid& grid, size_t first, size_t count, uint32_t surface);
    // Finds where the samples are from primitive, u and v.
    void find_points(const raytrace::Accel& accel) const;

    raytrace::HitBatch hits;
    std::span<uint32_t> instance, primitive;
    float *u, *v;
    raytrace::Accel::SurfacePoints on_surface;
    // By solid angle, of one sample alone; 0 where a point has no sample.
    static constexpr float kByArea = -1;  // it follows from the area
    float* density;
    float* share;  // what counts of a sample: of the directions that were tried, those that met
};

// A light on geometry: its triangles by area, and what they are together.
struct AreaLight {
    std::vector<uint32_t> surfaces;  // of more than one where it emits
    std::vector<uint32_t> first;     // triangle of each surface, and how many there are
    bool directed = false;           // else its light comes from no point of it
    bool emits = false;              // what its surfaces show by themselves, in the place of Cl
    std::vector<double> areas;       // of the triangles
    std::vector<float> power;        // samples by area, of each; none: all alike
    std::vector<float> below;        // area times power of the triangles up to each, summed
    bool known = false;
    LampShape shape;         // of all triangles, accel space
    PlaneFacets facets;      // of a rectangle of few triangles
    bool by_angle = false;   // its samples are even in the solid angle of the shape
    bool hides_far = false;  // its triangles let no shadow ray through to those behind them
    bool has_area() const { return !below.empty() && below.back() > 0; }
    bool has(uint32_t surface) const { return std::ranges::binary_search(surfaces, surface); }
    // The area that the whole light would have, were it as dense in samples as at a triangle.
    float area_at(uint32_t surface, uint32_t triangle) const;
};

// A place on the light's triangles, even in weight for u in the unit square.
struct LampPlace {
    uint32_t surface = 0, triangle = 0;
    vec2 uv{0.0f};
};
LampPlace place_on(const AreaLight& light, vec2 u);

// Samples of lights that have an extent: of those on geometry and of solar with an angle. Where
// neither the option nor the file says how many, a surface with rays of indirect light takes fewer,
// as these bring the more noise.
uint32_t light_samples(const ShadingFrame& frame, size_t light, bool beside_indirect);

class AreaLights {
  public:
    AreaLights(const ShadingFrame& frame, const LightBindings& bindings);
    // Areas and shapes once, and again in each frame where the mesh may deform or be scaled.
    void begin_frame();
    // Light `light` among Scene::lights; null where it is none on geometry.
    const AreaLight* find(size_t light) const { return lights_[light].get(); }
    // Those on geometry.
    std::span<const size_t> all() const { return all_; }
    void sample_by_angle(size_t light, bool by_angle) { lights_[light]->by_angle = by_angle; }
    // Triangles of a light get samples by their area times `power`, one number for each; none: by
    // area alone.
    void weigh(size_t light, std::span<const float> power);

  private:
    void find_areas(AreaLight& light);
    void add_areas(AreaLight& light, uint32_t surface);
    static void sum_up(AreaLight& light);
    void find_shape(AreaLight& light);
    bool hides_far(size_t light) const;

    const ShadingFrame& frame_;
    const LightBindings& bindings_;
    std::vector<std::unique_ptr<AreaLight>> lights_;
    std::vector<dvec3> corners_;  // of one light's triangles that have an area
    std::vector<uint32_t> numbers_;
    std::vector<size_t> all_;
};

}  // namespace kinora
