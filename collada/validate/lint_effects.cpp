// collada/validate/lint_effects.cpp: transparency in parts that readers fill in differently.
#include <algorithm>

#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

const char* opaque_name(Opaque opaque) {
    switch (opaque) {
        case Opaque::AOne:
            return "A_ONE";
        case Opaque::RgbZero:
            return "RGB_ZERO";
        case Opaque::AZero:
            return "A_ZERO";
        case Opaque::RgbOne:
            return "RGB_ONE";
    }
    return "";
}

// COLLADA 1.4.1 and 1.5, "Determining Transparency": the largest opacity of the three channels.
double opacity(const CommonShading& common) {
    const Slot& color = common[CommonSlot::Transparent].slot;
    const CommonValue& scale = common[CommonSlot::Transparency];
    double t = scale.source == SlotSource::Value ? scale.slot.values[0] : 1.0;
    bool by_alpha = common.opaque == Opaque::AOne || common.opaque == Opaque::AZero;
    bool inverted = common.opaque == Opaque::AZero || common.opaque == Opaque::RgbZero;
    double largest = 0;
    for (int c = 0; c < 3; ++c) {
        double part = t * color.values[size_t(by_alpha ? 3 : c)];
        largest = std::max(largest, inverted ? 1 - part : part);
    }
    return largest;
}

void check_parts(Lint& lint, const Effect& effect) {
    const CommonShading& common = *effect.common;
    const CommonValue& scale = common[CommonSlot::Transparency];
    const CommonValue& transparent = common[CommonSlot::Transparent];
    if (transparent.source == SlotSource::Absent && scale.source == SlotSource::Value &&
        scale.slot.values[0] != 1.0)
        lint.diag.report(
            Code::FX_OPAQUE_MODE, scale.where,
            fmt::format("transparency {} without <transparent>", scale.slot.values[0]));
    bool new_mode = common.opaque == Opaque::AZero || common.opaque == Opaque::RgbOne;
    if (new_mode && lint.document.version() != Version::V1_5_0)
        lint.diag.report(Code::FX_OPAQUE_MODE, transparent.where,
                         fmt::format("opaque=\"{}\" belongs to version 1.5; this is 1.4",
                                     opaque_name(common.opaque)));
}

// A picture half seen through, by a mode that other importers take inverted.
void check_port(Lint& lint, const Effect& effect) {
    const CommonShading& common = *effect.common;
    const CommonValue& transparent = common[CommonSlot::Transparent];
    if (transparent.source != SlotSource::Value || common.opaque == Opaque::AOne) return;
    double solid = opacity(common);
    if (solid > 0.002 && solid < 0.998)
        lint.diag.report(Code::PORT_TRANSPARENCY, transparent.where, opaque_name(common.opaque));
}

}  // namespace

void lint_effects(Lint& lint) {
    for (const Effect& effect : lint.scene.effects) {
        if (!effect.common || effect.rsl || effect.document != 0) continue;
        check_port(lint, effect);
        check_parts(lint, effect);
    }
}

}  // namespace kinora::collada
