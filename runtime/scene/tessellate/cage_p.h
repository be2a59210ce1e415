// runtime/scene/tessellate/cage_p.h: the meshes of quads that a Catmull-Clark mesh becomes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "runtime/base/math.h"
#include "runtime/scene/description/curved_surface.h"

namespace kinora::tessellation {

// A face of four points, or one of the quads that another face becomes: what has u, v of its own.
struct RootQuad {
    uint32_t face = 0;
    uint32_t first = 0;  // the face's corners, among the surface's indices
    uint32_t size = 4;
    uint32_t corner = 0;  // of faces of another size: where the quad is
    bool drawn = true;
};

// The part of its root's u, v that a quad has.
struct QuadPlace {
    uint32_t root = 0;
    float u = 0, v = 0, size = 1;
};

struct CageEdge {
    uint32_t from = 0, to = 0;
    uint32_t faces = 0;
    bool smooth() const { return faces == 2; }  // any other bounds the surface, or parts it
};

// Quads with consistent edges: edge k of a quad is from its point k to the next.
struct Cage {
    uint32_t stride = 3;         // doubles a point: its place, and vertex variables
    std::vector<double> values;  // of points
    std::vector<CageEdge> edges;
    std::vector<std::array<uint32_t, 4>> quads, quad_edges;
    std::vector<QuadPlace> places;
    std::vector<RootQuad> roots;  // of the first cage, which all use
    std::vector<uint8_t> fixed;   // points that stay where they are

    size_t points() const { return values.size() / stride; }
    dvec3 place(size_t point) const {
        const double* p = &values[point * stride];
        return {p[0], p[1], p[2]};
    }
};

// Faces that have points twice, points that are not there, or fewer than three are left out.
// Variables of vertex rate that are sound follow the places, in their order.
Cage make_cage(const SubdivisionSurface& surface,
               const std::vector<const SurfaceVariable*>& vertex_variables);

// The next cage; roots stay behind.
Cage refine(const Cage& cage);

// Places, variables and unit normals (zero where there is none) of points in the limit.
struct CageLimit {
    std::vector<double> values;
    std::vector<dvec3> normals;
};
CageLimit limit_of(const Cage& cage, bool with_normals);

}  // namespace kinora::tessellation
