// runtime/scene/tessellate/basis_p.h: weights of the control points that a patch blends.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "runtime/scene/tessellate/sheet_p.h"

namespace kinora::tessellation {

inline constexpr uint32_t kLargestOrder = 64;

// Weights of `order` control points: of the value, of its first and of its second derivative by
// the patch's parameter.
struct Weights {
    double value[kLargestOrder], first[kLargestOrder], second[kLargestOrder];
};

// One direction of a control net.
struct Basis {
    void (*weights)(const Basis& basis, const Line& line, Weights& result) = nullptr;
    const Direction* direction = nullptr;
    const dmat4* matrix = nullptr;  // bicubic: matrix[column][row], for [t^3 t^2 t 1] M G
    std::vector<double> knots;      // NURBS
};

// How a direction of such a surface is cut into patches; the basis is for it. Nothing where the
// numbers give none.
std::optional<Basis> make_basis(CurvedKind kind, const PatchDirection& from, Direction& direction);

}  // namespace kinora::tessellation
