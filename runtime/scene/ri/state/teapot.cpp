// runtime/scene/ri/state/teapot.cpp: the teapot of Martin Newell (1975), as its 32 Bezier patches:
// a body turned about z, and a handle and a spout that y mirrors.
#include <array>

#include "runtime/scene/ri/calls/ri.h"
#include "runtime/scene/ri/state/primitives.h"

namespace kinora::ri {
namespace {

struct Profile {
    double radius[4], z[4];
};
// Rim, body, lid and bottom; `z` falls along each.
constexpr Profile kProfiles[] = {
    {{1.4, 1.3375, 1.4375, 1.5}, {2.4, 2.53125, 2.53125, 2.4}},
    {{1.5, 1.75, 2, 2}, {2.4, 1.875, 1.35, 0.9}},
    {{2, 2, 1.5, 1.5}, {0.9, 0.45, 0.225, 0.15}},
    {{0, 0.8, 0, 0.2}, {3.15, 3.15, 2.85, 2.7}},
    {{0.2, 0.4, 1.3, 1.3}, {2.7, 2.55, 2.55, 2.4}},
    {{1.5, 1.5, 1.425, 0}, {0.15, 0.075, 0, 0}},
};

// Half a cross-section in each row: two points, of which y = 0 for the first and last.
struct HalfTube {
    double x[4][4], y[4], z[4][4];
};
constexpr HalfTube kTubes[] = {
    // The handle.
    {{{-1.6, -1.6, -1.5, -1.5},
      {-2.3, -2.3, -2.5, -2.5},
      {-2.7, -2.7, -3, -3},
      {-2.7, -2.7, -3, -3}},
     {0.3, 0.3, 0.3, 0.3},
     {{2.025, 2.025, 2.25, 2.25},
      {2.025, 2.025, 2.25, 2.25},
      {2.025, 2.025, 2.25, 2.25},
      {1.8, 1.8, 1.8, 1.8}}},
    {{{-2.7, -2.7, -3, -3}, {-2.7, -2.7, -3, -3}, {-2.5, -2.5, -2.65, -2.65}, {-2, -2, -1.9, -1.9}},
     {0.3, 0.3, 0.3, 0.3},
     {{1.8, 1.8, 1.8, 1.8},
      {1.575, 1.575, 1.35, 1.35},
      {1.125, 1.125, 0.9375, 0.9375},
      {0.9, 0.9, 0.6, 0.6}}},
    // The spout.
    {{{1.7, 1.7, 1.7, 1.7}, {2.6, 2.6, 3.1, 3.1}, {2.3, 2.3, 2.4, 2.4}, {2.7, 2.7, 3.3, 3.3}},
     {0.66, 0.66, 0.25, 0.25},
     {{1.425, 1.425, 0.6, 0.6},
      {1.425, 1.425, 0.825, 0.825},
      {2.1, 2.1, 2.025, 2.025},
      {2.4, 2.4, 2.4, 2.4}}},
    {{{2.7, 2.7, 3.3, 3.3}, {2.8, 2.8, 3.525, 3.525}, {2.9, 2.9, 3.45, 3.45}, {2.8, 2.8, 3.2, 3.2}},
     {0.25, 0.25, 0.15, 0.15},
     {{2.4, 2.4, 2.4, 2.4},
      {2.475, 2.475, 2.49375, 2.49375},
      {2.475, 2.475, 2.5125, 2.5125},
      {2.4, 2.4, 2.4, 2.4}}},
};

CurvedSurface bezier_patch(const Attributes& attributes) {
    CurvedSurface made;
    made.kind = CurvedKind::Bicubic;
    made.reversed = is_front_reversed(attributes);
    std::ranges::copy(attributes.corners, made.corners);
    made.u.points = made.v.points = 4;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c)
            made.u.basis[c][r] = made.v.basis[c][r] = double(RiBezierBasis[r][c]);
    return made;
}

// A quarter of a turn, from 90 degrees times `quarter` on; Newell's arcs have handles of .56.
CurvedSurface turned(const Profile& profile, int quarter, const Attributes& attributes) {
    constexpr double kAcross[] = {1, 1, 0.56, 0}, kUp[] = {0, 0.56, 1, 1};
    CurvedSurface made = bezier_patch(attributes);
    for (size_t row = 4; row-- > 0;)  // upwards, so that normals point outwards
        for (size_t i = 0; i < 4; ++i) {
            double x = profile.radius[row] * kAcross[i], y = profile.radius[row] * kUp[i];
            for (int q = 0; q < quarter; ++q) std::tie(x, y) = std::pair(-y, x);
            made.points.emplace_back(x, y, profile.z[row], 1.0);
        }
    return made;
}

CurvedSurface tube(const HalfTube& half, bool mirrored, const Attributes& attributes) {
    CurvedSurface made = bezier_patch(attributes);
    for (size_t row = 0; row < 4; ++row)
        for (size_t i = 0; i < 4; ++i) {
            size_t at = mirrored ? 3 - i : i;
            double y = at == 0 || at == 3 ? 0 : half.y[row];
            made.points.emplace_back(half.x[row][at], mirrored ? y : -y, half.z[row][at], 1.0);
        }
    return made;
}

}  // namespace

std::vector<CurvedSurface> teapot(const Attributes& attributes) {
    std::vector<CurvedSurface> patches;
    for (const Profile& profile : kProfiles)
        for (int quarter = 0; quarter < 4; ++quarter)
            patches.push_back(turned(profile, quarter, attributes));
    for (const HalfTube& half : kTubes)
        for (bool mirrored : {false, true}) patches.push_back(tube(half, mirrored, attributes));
    return patches;
}

}  // namespace kinora::ri
