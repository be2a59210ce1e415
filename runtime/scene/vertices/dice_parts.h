// runtime/scene/vertices/dice_parts.h: the triangles of a mesh split, by several threads, in parts
// that are each one's own.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/base/arena.h"
#include "runtime/base/parallel.h"
#include "runtime/scene/shapes.h"
#include "runtime/scene/vertices/dice.h"

namespace kinora {

// Whether the edge between two points of a triangle is longer than `times` what is allowed;
// `corners` are positions of the base mesh. Must depend on the two positions alone. Called by
// several threads.
using DiceTest =
    FunctionRef<bool(const uint32_t corners[3], DicePoint a, DicePoint b, double times)>;

// A triangle, or a part of a large one: as DicedTriangle has it.
struct DicedPart {
    uint32_t triangle = 0;                // of the group; points are in it
    std::span<const DicePoint> points;    // none: the triangle itself
    std::span<const uint32_t> triangles;  // of points
    std::span<const uint32_t> rim;        // points that other parts may have, too; in order
};

struct DicedParts {
    std::vector<std::vector<DicedPart>> groups;  // parts in the order of the triangles they make
    size_t triangles = 0;
    std::vector<Arena> memory;  // of the parts
};

// Splits the triangles of the groups that are marked in `diced`, and those of the others along the
// edges they share with them. Nothing when there would be more than `limit` triangles.
std::optional<DicedParts> dice_parts(const Mesh& base, std::span<const uint8_t> diced,
                                     DiceTest longer, size_t limit);

}  // namespace kinora
