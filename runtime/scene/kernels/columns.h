// runtime/scene/kernels/columns.h: the point-rate inputs a kernel may ask for, as columns of a
// grid.
#pragma once

#include <cstdint>

#include "rsl/model/kernel_keys.h"

namespace kinora {

// First column of each shader global; triples take three, matrices twelve (row by row).
enum Column : uint16_t {
    kColP = 0,
    kColdPdu = 3,
    kColdPdv = 6,
    kColN = 9,
    kColNg = 12,
    kColI = 15,
    kColdNdu = 18,
    kColdNdv = 21,
    kColdIdu = 24,
    kColdIdv = 27,
    kColPs = 30,
    kColNs = 33,
    kColU = 36,
    kColV,
    kColDu,
    kColDv,
    kColS,
    kColT,
    kColdsdu,
    kColdsdv,
    kColdtdu,
    kColdtdv,
    kColRng,
    kColOne,  // 1 everywhere: the derivative of u by u
    kColCi,   // what the surface, or the picture so far, sends on: volumes and imagers
    kColOi = kColCi + 3,
    kColAlpha = kColOi + 3,
    kColToCurrent,  // space:object:to_current and space:shader:...
    kColFromCurrent = kColToCurrent + 12,
    kColSentL = kColFromCurrent + 12,  // L of a light that comes from a cone; 0: its axis
    kColVarying = kColSentL + 3,       // then ShaderInstance::varying, each value and its du and dv
};

// Columns that hold one number everywhere: u and v are the parameters of the surface.
struct ConstantColumn {
    uint16_t column;
    float value;
};
inline constexpr ConstantColumn kConstantColumns[] = {
    {kColOne, 1}, {kColdsdu, 1}, {kColdsdv, 0}, {kColdtdu, 0}, {kColdtdv, 1}};

// Column of a kernel input; varying parameters are looked up by their look. kNoColumn: not a
// column.
inline constexpr uint16_t kNoColumn = 0xffff;
uint16_t find_column(const rsl::KernelKey& key);

}  // namespace kinora
