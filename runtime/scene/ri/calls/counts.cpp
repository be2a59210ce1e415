// runtime/scene/ri/calls/counts.cpp: how many values the variables of a primitive have (3.2,
// section 5).
#include <fmt/core.h>

#include <algorithm>
#include <numeric>

#include "runtime/scene/ri/calls/context.h"

namespace kinora::ri {
namespace {

// Sums and products of what a file says stay below this: more is no scene.
constexpr uint64_t kMostValues = 1u << 31;

CountedCall counted(uint64_t uniform, uint64_t varying, uint64_t vertex, uint64_t face_varying) {
    if (std::max({uniform, varying, vertex, face_varying}) >= kMostValues)
        return {{}, "more than 2^31 values"};
    return {{uint32_t(uniform), uint32_t(varying), uint32_t(vertex), uint32_t(face_varying)}, ""};
}

CountedCall refused(std::string why) {
    return {{}, std::move(why)};
}

// The sum of counts none of which may be negative.
struct Sum {
    uint64_t value = 0;
    bool negative = false;
};
Sum sum_of(std::span<const int> counts) {
    Sum sum;
    for (int count : counts) {
        if (count < 0)
            sum.negative = true;
        else
            sum.value += uint64_t(count);
    }
    return sum;
}

CountedCall by_points(uint32_t points) {
    return counted(1, points, points, points);
}

CountedCall of_loops(std::span<const int> loops) {
    Sum points = sum_of(loops);
    if (points.negative) return refused("a loop has a negative number of points");
    return counted(1, points.value, points.value, points.value);
}

// Faces whose corners are `corners` indices of points.
CountedCall of_faces(size_t faces, const Sum& corners, std::span<const int> indices) {
    if (corners.negative) return refused("a face has a negative number of corners");
    if (corners.value != indices.size())
        return refused(fmt::format("the faces have {} corners, and there are {} indices",
                                   corners.value, indices.size()));
    int highest = -1;
    for (int index : indices) {
        if (index < 0) return refused("an index is negative");
        highest = std::max(highest, index);
    }
    uint64_t points = uint64_t(highest) + 1;
    return counted(faces, points, points, corners.value);
}

CountedCall of_general_polygons(std::span<const Values> arguments) {
    Sum loops = sum_of(arguments[0].integers());
    if (loops.negative) return refused("a polygon has a negative number of loops");
    if (loops.value != arguments[1].size())
        return refused(fmt::format("the polygons have {} loops, and {} are counted", loops.value,
                                   arguments[1].size()));
    return of_faces(arguments[0].size(), sum_of(arguments[1].integers()), arguments[2].integers());
}

// Patches along one direction of a mesh; 0: the number of points makes none.
uint64_t patches_along(int points, bool bicubic, bool periodic, int step) {
    if (points < (bicubic ? 4 : 2) && !(bicubic && periodic && points > 0)) return 0;
    if (!bicubic) return uint64_t(periodic ? points : points - 1);
    step = std::max(step, 1);
    return uint64_t(periodic ? points / step : (points - 4) / step + 1);
}

// Why points along a direction of a mesh make no whole number of patches; "": they make it.
std::string patches_left_over(char direction, int points, bool bicubic, bool periodic, int step) {
    step = std::max(step, 1);
    const int rest = !bicubic ? 0 : periodic ? points % step : (points - 4) % step;
    if (rest == 0) return "";
    return fmt::format("{} points along {} are {} {}, as its basis needs", points, direction,
                       periodic ? "no multiple of" : "not 4 and a multiple of", step);
}

CountedCall of_patch_mesh(std::span<const Values> arguments, const CountState& state) {
    bool bicubic = arguments[0].string() == "bicubic";
    int nu = arguments[1].integer(), nv = arguments[3].integer();
    bool uwrap = arguments[2].string() == "periodic", vwrap = arguments[4].string() == "periodic";
    uint64_t u = patches_along(nu, bicubic, uwrap, state.ustep);
    uint64_t v = patches_along(nv, bicubic, vwrap, state.vstep);
    if (!u || !v) return refused(fmt::format("{} by {} points make no patch", nu, nv));
    for (const std::string& why : {patches_left_over('u', nu, bicubic, uwrap, state.ustep),
                                   patches_left_over('v', nv, bicubic, vwrap, state.vstep)})
        if (!why.empty()) return refused(why);
    uint64_t corners = (u + !uwrap) * (v + !vwrap);
    return counted(u * v, corners, uint64_t(nu) * uint64_t(nv), corners);
}

CountedCall of_nurbs(std::span<const Values> arguments) {
    int64_t nu = arguments[0].integer(), uorder = arguments[1].integer();
    int64_t nv = arguments[5].integer(), vorder = arguments[6].integer();
    if (nu < 1 || nv < 1 || uorder < 1 || vorder < 1)
        return refused("a number of points or an order is below 1");
    uint64_t u = uint64_t(std::max<int64_t>(1 + nu - uorder, 1));
    uint64_t v = uint64_t(std::max<int64_t>(1 + nv - vorder, 1));
    return counted(u * v, (u + 1) * (v + 1), uint64_t(nu * nv), (u + 1) * (v + 1));
}

CountedCall of_curves(std::span<const Values> arguments, const CountState& state) {
    bool cubic = arguments[0].string() == "cubic", periodic = arguments[2].string() == "periodic";
    uint64_t vertices = 0, varying = 0;
    for (int points : arguments[1].integers()) {
        if (points < 0) return refused("a curve has a negative number of points");
        vertices += uint64_t(points);
        uint64_t segments = patches_along(points, cubic, periodic, state.vstep);
        varying += segments + !periodic;
    }
    return counted(arguments[1].size(), varying, vertices, varying);
}

}  // namespace

CountedCall count_values(Request request, std::span<const Values> arguments,
                         const CountState& state, uint32_t vertices) {
    switch (request) {
        case Request::Polygon:
        case Request::Points:
            return by_points(vertices);
        case Request::GeneralPolygon:
            return of_loops(arguments[0].integers());
        case Request::PointsPolygons:
            return of_faces(arguments[0].size(), sum_of(arguments[0].integers()),
                            arguments[1].integers());
        case Request::PointsGeneralPolygons:
            return of_general_polygons(arguments);
        case Request::SubdivisionMesh:
            return of_faces(arguments[1].size(), sum_of(arguments[1].integers()),
                            arguments[2].integers());
        case Request::Patch:
            return counted(1, 4, arguments[0].string() == "bicubic" ? 16 : 4, 4);
        case Request::PatchMesh:
            return of_patch_mesh(arguments, state);
        case Request::NuPatch:
            return of_nurbs(arguments);
        case Request::Curves:
            return of_curves(arguments, state);
        case Request::Blobby: {
            uint64_t leaves = uint64_t(std::max(arguments[0].integer(), 0));
            return counted(1, leaves, leaves, leaves);
        }
        case Request::Sphere:
        case Request::Cone:
        case Request::Cylinder:
        case Request::Hyperboloid:
        case Request::Paraboloid:
        case Request::Disk:
        case Request::Torus:
            return counted(1, 4, 4, 4);
        default:
            return counted(1, 1, 1, 1);
    }
}

}  // namespace kinora::ri
