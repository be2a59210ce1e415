// runtime/scene/ri/state/primitives.h: calls of primitives to meshes and curved surfaces.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/description/curved_surface.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/ri/calls/call.h"
#include "runtime/scene/ri/state/graphics_state.h"

namespace kinora::ri {

// What a primitive lies in, in object space.
struct Ball {
    dvec3 center;
    double radius;
};
// By its numbers and control points. Nothing: they do not tell.
std::optional<Ball> ball_of(const Call& call, const Attributes& attributes);

// Polygon and its three relatives as triangles. Without N they are flat. Their s, t are x, y of
// object space where no variable gives them. Nothing: no triangle has an area.
std::optional<MeshDefinition> polygon_mesh(const Call& call, const Attributes& attributes);

// Quadrics, patches and NURBS. Nothing: they have no points, or their numbers make none.
std::optional<CurvedSurface> curved_surface(const Call& call, const Attributes& attributes);

// SubdivisionMesh, without its tags but "interpolateboundary". Without points where P does not give
// all that the faces name.
SubdivisionSurface subdivision_surface(const Call& call, const Attributes& attributes);
// Whether tags make some of it sharper or leave faces out.
bool has_creases(const Call& call);

// The patches of Geometry "teapot".
std::vector<CurvedSurface> teapot(const Attributes& attributes);

// Indices of a polygon's triangles that count its corners turn by this.
bool is_front_reversed(const Attributes& attributes);

// The points that "P" gives (w of "Pw" left out); empty: there are none.
std::vector<dvec3> points_of(const Call& call);

}  // namespace kinora::ri
