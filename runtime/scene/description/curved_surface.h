// runtime/scene/description/curved_surface.h: surfaces by formulas, as formats bring them:
// quadrics, meshes of patches, NURBS. runtime/scene/tessellate makes triangles of them for a
// picture's size.
//
// Each is a map from parameters u, v to places, in object space. Its own normal is dP/du x dP/dv.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/base/math.h"

namespace kinora {

// How many values a surface has of a variable: one; one a patch (u fastest); one a corner of
// patches; one a control point, which the basis blends as it does places; one a corner of each face
// of a subdivision mesh, and as Varying elsewhere.
enum class VariableRate : uint8_t { Constant, Uniform, Varying, Vertex, FaceVarying };

struct SurfaceVariable {
    std::string name;  // "Cs", "dirt"; "s", "t" and "st" are texture coordinates, "N" normals
    VariableRate rate = VariableRate::Constant;
    uint32_t components = 1;
    std::vector<float> values;
};

enum class CurvedKind : uint8_t {
    Sphere,       // radius, zmin, zmax, thetamax
    Cone,         // height, radius, thetamax
    Cylinder,     // radius, zmin, zmax, thetamax
    Hyperboloid,  // x1 y1 z1 x2 y2 z2, thetamax
    Paraboloid,   // rmax, zmin, zmax, thetamax
    Disk,         // height, radius, thetamax
    Torus,        // major radius, minor radius, phimin, phimax, thetamax
    Bilinear,     // a mesh of patches over `points`
    Bicubic,
    Nurbs,
};
inline constexpr bool is_quadric(CurvedKind kind) {
    return kind <= CurvedKind::Torus;
}

// One direction of a mesh of patches or of a NURBS. Numbers of points are at least those of one
// patch.
struct PatchDirection {
    uint32_t points = 0;
    bool periodic = false;      // patches
    uint32_t step = 3;          // bicubic: points from a patch to the next
    dmat4 basis{1.0};           // bicubic: basis[column][row], for [t^3 t^2 t 1] M G
    uint32_t order = 0;         // NURBS: degree + 1, at most `points`
    std::vector<double> knots;  // points + order, none below the one before
    double low = 0, high = 1;   // NURBS: the part of the parameter that is drawn
};

// A loop of curves in a NURBS' parameters: what lies outside (by the even-odd rule over all loops)
// is not there. A polyline, closed.
using TrimLoop = std::vector<dvec2>;

struct CurvedSurface {
    CurvedKind kind = CurvedKind::Sphere;
    double numbers[7] = {};       // of quadrics, in the order above; angles in degrees
    PatchDirection u, v;          // of meshes and NURBS
    std::vector<dvec4> points;    // u fastest; w is 1 where it is not rational
    bool rational = false;        // vertex variables are not divided by w
    std::vector<TrimLoop> trims;  // NURBS; none: all is there
    bool trim_outside = false;    // what lies inside is not there
    // Texture coordinates at (u, v) = (low, low), (high, low), (low, high), (high, high), blended
    // over the whole surface, where no variable gives them.
    double corners[8] = {0, 0, 1, 0, 0, 1, 1, 1};
    bool reversed = false;  // its front is the side that dP/du x dP/dv points away from
    std::vector<SurfaceVariable> variables;
};

// A Catmull-Clark mesh. Uniform variables have one value a face, varying and vertex ones one a
// point, facevarying ones one an index.
struct SubdivisionSurface {
    std::vector<uint32_t> face_sizes;
    std::vector<uint32_t> indices;  // of the faces' points, one face behind the other
    std::vector<dvec3> points;
    bool draw_boundary = false;  // without it faces with a point on the boundary are not there
    bool sharp_corners = true;   // points of one face alone stay where they are
    bool reversed = false;       // the front's normal is not that of counter-clockwise faces
    std::vector<SurfaceVariable> variables;
};

}  // namespace kinora
