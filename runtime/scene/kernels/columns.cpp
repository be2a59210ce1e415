// runtime/scene/kernels/columns.cpp: point-rate inputs to columns.
#include "runtime/scene/kernels/columns.h"

namespace kinora {

namespace {

using rsl::Global;
using rsl::KernelKey;
using rsl::KeyKind;

// The first column of a global and those of its changes along u and v.
struct Row {
    Global id;
    uint16_t column;
    uint16_t du = kNoColumn;
    uint16_t dv = kNoColumn;
};
constexpr Row kRows[] = {
    {Global::P, kColP},
    {Global::dPdu, kColdPdu},
    {Global::dPdv, kColdPdv},
    {Global::N, kColN, kColdNdu, kColdNdv},
    {Global::Ng, kColNg},
    {Global::I, kColI, kColdIdu, kColdIdv},
    {Global::Ps, kColPs},
    {Global::Ns, kColNs},
    {Global::u, kColU},
    {Global::v, kColV},
    {Global::du, kColDu},
    {Global::dv, kColDv},
    {Global::s, kColS, kColdsdu, kColdsdv},
    {Global::t, kColT, kColdtdu, kColdtdv},
    {Global::Ci, kColCi},
    {Global::Oi, kColOi},
    {Global::alpha, kColAlpha},
};

uint16_t global_column(const KernelKey& key) {
    for (const Row& row : kRows) {
        if (row.id != key.global()) continue;
        uint16_t first = key.partial == rsl::Partial::None ? row.column
                         : key.partial == rsl::Partial::Du ? row.du
                                                           : row.dv;
        return first == kNoColumn ? kNoColumn : uint16_t(first + key.component);
    }
    return kNoColumn;
}

uint16_t space_column(const KernelKey& key, uint16_t first) {
    static const int32_t object = rsl::name_id("object"), shader = rsl::name_id("shader");
    bool gathered = (key.name == object || key.name == shader) && key.row() < 3;
    return gathered ? uint16_t(first + key.component) : kNoColumn;
}

}  // namespace

uint16_t find_column(const KernelKey& key) {
    switch (key.kind) {
        case KeyKind::Global:
            return global_column(key);
        case KeyKind::One:
            return kColOne;
        case KeyKind::Rng:
            return kColRng;
        case KeyKind::SpaceToCurrent:
            return space_column(key, kColToCurrent);
        case KeyKind::SpaceFromCurrent:
            return space_column(key, kColFromCurrent);
        case KeyKind::LightRecord:
            return key.light_column() == rsl::kLightL ? uint16_t(kColSentL + key.component)
                                                      : kNoColumn;
        case KeyKind::None:
        case KeyKind::CameraNear:
        case KeyKind::CameraFar:
        case KeyKind::Parameter:
        case KeyKind::Aov:
        case KeyKind::Message:
            break;
    }
    return kNoColumn;
}

}  // namespace kinora
