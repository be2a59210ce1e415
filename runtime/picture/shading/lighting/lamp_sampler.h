// runtime/picture/shading/lighting/lamp_sampler.h: where on a light on geometry each lit point
// looks, and how dense such samples are.
#pragma once

#include "runtime/picture/lights/solid_angle.h"
#include "runtime/picture/shading/lighting/area_light.h"

namespace kinora {

// One of the samples that a light has at a point.
struct SampleNumber {
    uint32_t number, of;
};

// The samples of one light at lit points. Where the light's samples are even in solid angle, each
// is a direction, and what it meets of the triangles counts: all of it, or the nearest where that
// hides the rest. At the rim of a sphere, where the triangles may be missed, a sample tries sixteen
// directions and is one of those that meet them.
class LampSampler {
  public:
    LampSampler(const AreaLight& light, const LightPoints& at, ThreadMemory& memory);
    // A sample for each point; `lit` is the grid that the light's kernel runs on.
    void choose(const Grid& lit, SampleNumber sample, LightSamples& samples);
    // The samples go on to what their directions meet behind; false where none meets anything.
    bool go_on(const Grid& lit, LightSamples& samples);
    // By solid angle, of the direction of any sample at a point; LightSamples::kByArea where it
    // depends on the sample.
    float density(size_t point) const;

  private:
    // A sample's way to the triangles that it is to meet: from the point, as a multiple of `dir`.
    struct Ray {
        vec3 dir;
        float near, far;
        float window;  // as in RayPacket16
        uint32_t passed_first, passed_last;
    };
    using Row = std::span<const Ray, kAngleLanes>;

    void see(Arena& arena);
    void see_rectangle(size_t row);
    void see_sphere(size_t row);
    void take_density(size_t point, double density);
    size_t point_of(size_t row) const { return std::min(row, at_.count - 1); }
    void choose_by_area(size_t first, const AngleLanes& u, const AngleLanes& v,
                        LightSamples& samples) const;
    void choose_on_rectangle(size_t first, const AngleLanes& u, const AngleLanes& v,
                             LightSamples& samples);
    void choose_on_sphere(const Grid& lit, size_t first, const AngleLanes& u, const AngleLanes& v,
                          LightSamples& samples);
    // Whether some of its directions meet the triangles. A number `seed` decides.
    bool choose_at_rim(const Grid& lit, size_t point, uint32_t seed, LightSamples& samples);
    bool meet(const Grid& lit, LightSamples& samples);
    void meet_sixteen(const Grid& lit, size_t first, LightSamples& samples);
    // The next triangle of the light on each way of `lanes`, which leave the points first, first +
    // step, ...; other lamps before it let the ray pass. The lanes that meet one.
    uint32_t find(const Grid& lit, std::span<Ray, kAngleLanes> rays, size_t first, size_t step,
                  uint32_t lanes, raytrace::HitPacket16& found) const;
    void load(Row rays, size_t first, size_t step, uint32_t lanes,
              raytrace::RayPacket16& packet) const;

    const AreaLight& light_;
    const LightPoints& at_;
    // Where samples are by angle: of points, and of rows of sixteen of them.
    std::span<float> density_;
    std::span<RectangleLanes> rectangles_;
    std::span<SphereLanes> spheres_;
    // Of a sphere: where rays may meet it, and the least u of directions that may miss.
    std::span<vec3> reach_;
    std::span<Ray> rays_;  // none where triangles of a rectangle are found without
    // A bit of each point of a row: samples by angle; those whose ray is on its way; of these, at
    // the rim of a sphere.
    std::span<uint16_t> by_angle_, on_way_, at_rim_;
};

}  // namespace kinora
