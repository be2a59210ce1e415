// tests/runtime/picture/light/path_tracer.cpp: paths between rectangles.
#include "tests/runtime/picture/light/path_tracer.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace kinora {

namespace {

constexpr double kNearest = 1e-9;

int next_of(int axis, int steps) {
    return (axis + steps) % 3;
}

double area_of(const PathWall& wall) {
    return (wall.high.x - wall.low.x) * (wall.high.y - wall.low.y);
}

}  // namespace

PathTracer::PathTracer(std::vector<PathWall> walls, size_t lamp, int bounces, uint32_t seed)
    : walls_(std::move(walls)), lamp_(lamp), bounces_(bounces), random_(seed) {}

bool PathTracer::meets(dvec3 from, dvec3 along, double most, Hit& hit) const {
    hit.far = most;
    bool any = false;
    for (size_t k = 0; k < walls_.size(); ++k) {
        const PathWall& wall = walls_[k];
        const double far = (wall.at - from[wall.axis]) / along[wall.axis];
        if (!(far > kNearest && far < hit.far)) continue;
        const int s = next_of(wall.axis, 1), t = next_of(wall.axis, 2);
        const double x = from[s] + far * along[s], y = from[t] + far * along[t];
        if (x < wall.low.x || x > wall.high.x || y < wall.low.y || y > wall.high.y) continue;
        hit = {far, k};
        any = true;
    }
    return any;
}

dvec3 PathTracer::on_lamp() {
    const PathWall& lamp = walls_[lamp_];
    dvec3 at(0.0);
    at[lamp.axis] = lamp.at;
    at[next_of(lamp.axis, 1)] = lamp.low.x + number() * (lamp.high.x - lamp.low.x);
    at[next_of(lamp.axis, 2)] = lamp.low.y + number() * (lamp.high.y - lamp.low.y);
    return at;
}

// Reflected by albedo 1: radiance x cosine x cosine' x area / (pi d^2) at one point of the lamp.
double PathTracer::direct(dvec3 at, dvec3 normal) {
    const PathWall& lamp = walls_[lamp_];
    const dvec3 way = on_lamp() - at;
    const double far2 = glm::dot(way, way), here = glm::dot(way, normal),
                 there = -way[lamp.axis] * lamp.shines;
    Hit hit;
    if (here <= 0 || there <= 0 || meets(at, way, 1 - 1e-6, hit)) return 0;
    return lamp.radiance * here * there * area_of(lamp) / (kPi * far2 * far2);
}

// By the cosine about the axis.
dvec3 PathTracer::scattered(int axis, double side) {
    const double square = number(), turn = 2 * kPi * number(), r = std::sqrt(square);
    dvec3 along(0.0);
    along[axis] = side * std::sqrt(1 - square);
    along[next_of(axis, 1)] = r * std::cos(turn);
    along[next_of(axis, 2)] = r * std::sin(turn);
    return along;
}

dvec3 PathTracer::path(dvec3 from, dvec3 along) {
    dvec3 sum(0.0), kept(1.0);
    for (int bounce = 0; bounce <= bounces_; ++bounce) {
        Hit hit;
        if (!meets(from, along, 1e30, hit)) break;
        const PathWall& wall = walls_[hit.wall];
        const double side = along[wall.axis] < 0 ? 1 : -1;  // of the wall, towards the ray
        if (bounce == 0 && side == wall.shines) sum += wall.radiance;
        from += hit.far * along;
        from[wall.axis] = wall.at;
        kept *= wall.albedo;
        dvec3 normal(0.0);
        normal[wall.axis] = side;
        sum += kept * direct(from, normal);
        along = scattered(wall.axis, side);
    }
    return sum;
}

}  // namespace kinora
