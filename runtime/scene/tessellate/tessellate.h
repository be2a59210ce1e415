// runtime/scene/tessellate/tessellate.h: triangles for surfaces by formulas, as fine as a picture
// needs them.
#pragma once

#include <optional>

#include "runtime/base/math.h"
#include "runtime/scene/description/curved_surface.h"
#include "runtime/scene/description/scene_description.h"

namespace kinora {

// How large things of an object are in the picture.
struct PictureScale {
    dmat4 to_camera{1.0};  // object space to x right, y up, z into the picture
    bool orthographic = false;
    // Pixels of a unit: at z = 1 in perspective, anywhere else. 0: there is no picture; surfaces
    // are as fine as ones that fill 1000 pixels.
    double pixels = 0;
    double near = 1e-3;  // what is nearer is not made finer
};

// The tangent of the widest angle from the axis of a view that is taken to be seen.
inline constexpr double kWidestView = 2;

// The scale of a thing (in a ball of object space) all of whose parts have about one size in the
// picture, as one of few, at least as fine: so that equal things have equal triangles wherever they
// stand. Nothing for other things.
std::optional<PictureScale> steady_scale(const PictureScale& scale, dvec3 center, double radius);

struct TessellationLimits {
    double error = 0.25;           // pixels between a surface and its triangles, at most
    size_t triangles = 1'000'000;  // of one surface; more are not made, the error is larger then
};

// Semantics of the result's attributes, beside NORMAL (set 0) and TEXCOORD (set 0, stride 2: s, t):
// kSurfaceParameters (stride 2: the surface's own parameters), and every variable by its name. All
// have entries by corner. Places are those of the formula, to rounding of doubles; where loops cut
// triangles, in the triangles.

struct Tessellation {
    std::vector<dvec3> positions;
    PrimitiveGroup group;  // symbol and sidedness are the caller's
    double error = 0;      // pixels, estimated
};

// Nothing is left of a surface without area, or of numbers that are not finite: no triangles. The
// winding is counter-clockwise as seen from the tip of the front's normal, in a right-handed
// system.
Tessellation tessellate(const CurvedSurface& surface, const PictureScale& scale,
                        const TessellationLimits& limits = {});

// A place of the surface with its derivatives (per unit of u and v as shaders have them) and the
// unit normal along du x dv. Where that is zero, as at poles, it is the limit from inside; zero
// where there is none.
struct SurfacePoint {
    dvec3 p{0.0}, du{0.0}, dv{0.0};
    dvec3 normal{0.0};
};
// u, v of quadrics and patches go from 0 to 1 over the whole surface, of NURBS from low to high.
SurfacePoint evaluate(const CurvedSurface& surface, double u, double v);

}  // namespace kinora
