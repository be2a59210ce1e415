// raytrace/geometry.h: what the ray tracer is told about a surface: views onto the caller's
// buffers.
#pragma once

#include <cstdint>
#include <span>

#include "runtime/base/math.h"

namespace kinora::raytrace {

inline constexpr uint32_t kNone = ~0u;  // "no geometry", "no primitive"

// Whose rays meet a surface: bits of Geometry::seen_by.
inline constexpr uint32_t kSeenByCamera = 1, kSeenByReflections = 2, kSeenByDiffuse = 4,
                          kSeenByShadows = 8, kSeenByAll = 15;
// With these, of a surface that is a light: rays that look for lamps meet it in any case.
inline constexpr uint32_t kSeenAsLamp = 1u << 8;

enum class GeometryKind : uint8_t {
    Static,     // never moves; all such rows are concatenated into one structure of MEDIUM quality
    Deforming,  // new positions now and then (positions_version): own structure, refitted
    Instanced,  // moves rigidly or is repeated: one structure per shape, one matrix per row
};

// One placed surface. The buffers stay the caller's and must keep their addresses until the row's
// next change is told to update(): update() and Accel::surface_points read them and, for Deforming
// and Instanced rows, every ray does. Accel space = world space relative to the caller's scene
// origin, as floats.
struct Geometry {
    uint32_t id = 0;  // the caller's name for this row; hits carry it
    GeometryKind kind = GeometryKind::Static;
    uint32_t seen_by = kSeenByAll;
    bool opaque = true;           // with seen_by the ray mask: of kMaskOpaque or kMaskNotOpaque
    bool hide_backfaces = false;  // camera rays pass through the side Ng points away from
    bool mirrored = false;        // positions were baked through a mirroring matrix: Ng is negated

    // Rows of one body share edges, where a ray meets it once. kNone: the row is a body.
    uint32_t body = kNone;

    // Accel space (Static, Deforming) or local space (Instanced). The fourth float is padding.
    std::span<const vec4> positions;
    std::span<const uint32_t> triangles;  // three indices a triangle

    // Deforming only: the same vertices in another pose, in any space, from which the first tree is
    // built before it is refitted (docs/rays.md#the-tree-over-a-clip). Empty: from `positions`.
    std::span<const vec4> built_from;

    uint32_t topology_version = 0;   // changed: the triangles are others, the structure is rebuilt
    uint32_t positions_version = 0;  // changed: same triangles, moved vertices

    // Instanced only. Rows of equal shape share one structure, made of the first such row, so their
    // positions and triangles must be the same buffers.
    uint32_t shape = kNone;       // kNone: shared with no other row
    dmat4 accel_from_local{1.0};  // composed in double by the caller; rounded to float once, here
};

}  // namespace kinora::raytrace
