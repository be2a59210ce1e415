// runtime/programs/tradeoff/probes.h: what is measured of a posed scene without a picture.
#pragma once

#include <span>
#include <vector>

#include "runtime/picture/compare/picture.h"
#include "runtime/scene/pose.h"
#include "runtime/scene/shapes.h"

namespace kinora {

// World positions of the vertices of each shape, at most `most` of one, evenly chosen.
std::vector<std::vector<dvec3>> vertex_positions(const SceneShapes& scene, const Pose& pose,
                                                 size_t most);

// Distances along the rays through the pixels' centres of Pose::view; infinite where none is hit.
// The pose's tree is that of the last frame.
std::vector<float> hit_distances(const Pose& pose);

// The largest distance between the same vertices; nothing where shapes have other numbers of them.
std::optional<double> largest_step(std::span<const std::vector<dvec3>> a,
                                   std::span<const std::vector<dvec3>> b);
// Likewise as Pose::view sees them, pixels; what lies behind the camera is left out.
std::optional<double> largest_step_pixels(const SceneExtent& scene, const Pose& pose,
                                          std::span<const std::vector<dvec3>> a,
                                          std::span<const std::vector<dvec3>> b);

struct HitErrors {
    double distance = 0;  // largest, where both hit
    double mismatch = 0;  // share of the rays that one of them hits alone
};
HitErrors hit_errors(std::span<const float> a, std::span<const float> b);

struct UlpErrors {
    double max = 0, p99 = 0;
};
// Of the colours of pixels whose distances are equal.
UlpErrors ulp_errors(const PictureView& a, const PictureView& b, std::span<const float> hits_a,
                     std::span<const float> hits_b);

}  // namespace kinora
