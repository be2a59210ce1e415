// tests/runtime/picture/light/path_tracer.h: paths between axis-parallel rectangles, in double
// precision. It shares no code with the renderer, which is judged by it.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "runtime/base/math.h"

namespace kinora {

// All points whose coordinate `axis` is `at` and whose two next ones lie between `low` and `high`.
struct PathWall {
    int axis = 0;
    double at = 0;
    dvec2 low{0.0}, high{0.0};
    dvec3 albedo{0.0};
    double radiance = 0;  // of a lamp, on the side of `shines` along the axis
    double shines = 0;
};

class PathTracer {
  public:
    // `walls[lamp]` is the one that shines.
    PathTracer(std::vector<PathWall> walls, size_t lamp, int bounces, uint32_t seed);
    // One path's light from there: of the lamp that it meets first, and of the direct light at each
    // diffuse surface up to so many bounces.
    dvec3 path(dvec3 from, dvec3 along);
    double number() { return unit_(random_); }

  private:
    struct Hit {
        double far = 0;
        size_t wall = 0;
    };
    bool meets(dvec3 from, dvec3 along, double most, Hit& hit) const;
    dvec3 on_lamp();
    double direct(dvec3 at, dvec3 normal);
    dvec3 scattered(int axis, double side);

    std::vector<PathWall> walls_;
    size_t lamp_;
    int bounces_;
    std::mt19937_64 random_;
    std::uniform_real_distribution<double> unit_;
};

}  // namespace kinora
