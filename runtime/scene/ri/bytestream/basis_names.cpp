// runtime/scene/ri/bytestream/basis_names.cpp: what RIB calls the bases of ri.h.
#include "runtime/scene/ri/bytestream/basis_names_p.h"

#include <cstring>

#include "runtime/scene/ri/calls/ri.h"

namespace kinora::ri {
namespace {

struct BasisRow {
    std::string_view name;
    const RtBasis& basis;
};
const BasisRow kBases[] = {
    {"bezier", RiBezierBasis},   {"b-spline", RiBSplineBasis}, {"catmull-rom", RiCatmullRomBasis},
    {"hermite", RiHermiteBasis}, {"power", RiPowerBasis},
};

}  // namespace

const float* basis_named(std::string_view name) {
    for (const BasisRow& row : kBases)
        if (row.name == name) return &row.basis[0][0];
    return nullptr;
}

std::string_view basis_name(std::span<const float> numbers) {
    for (const BasisRow& row : kBases)
        if (numbers.size_bytes() == sizeof row.basis &&
            std::memcmp(numbers.data(), row.basis, sizeof row.basis) == 0)
            return row.name;
    return "";
}

}  // namespace kinora::ri
