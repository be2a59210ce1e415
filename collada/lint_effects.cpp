// collada/lint_effects.cpp: transparency that means something else than it says.
#include <algorithm>

#include "collada/lint_p.h"

namespace kinora::collada {

namespace {

const char* opaque_name(Opaque opaque) {
    switch (opaque) {
        case Opaque::AOne: return "A_ONE";
        case Opaque::RgbZero: return "RGB_ZERO";
        case Opaque::AZero: return "A_ZERO";
        case Opaque::RgbOne: return "RGB_ONE";
    }
    return "";
}

bool is_known(const CommonValue& value) {
    return value.source == SlotSource::Absent || value.source == SlotSource::Value;
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

void check_opacity(Lint& lint, const Effect& effect, bool animated) {
    const CommonShading& common = *effect.common;
    const CommonValue& transparent = common[CommonSlot::Transparent];
    if (transparent.source != SlotSource::Value || animated ||
        !is_known(common[CommonSlot::Transparency]))
        return;
    constexpr double kInvisible = 1.0 / 512;  // rounds to 0 in 8 bits
    double solid = opacity(common);
    if (solid < kInvisible)
        lint.diag.report(Code::FX_TRANSPARENT_ALL, transparent.where, effect.id,
                         opaque_name(common.opaque));
    else if (solid < 1 - kInvisible && common.opaque != Opaque::AOne)
        lint.diag.report(Code::PORT_TRANSPARENCY, transparent.where, opaque_name(common.opaque));
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

}  // namespace

void lint_effects(Lint& lint) {
    std::vector<bool> animated(lint.scene.effects.size());
    for (const Channel& channel : lint.scene.channels)
        if (channel.ref.kind == Owner::EffectCommon &&
            (channel.ref.slot == uint32_t(CommonSlot::Transparent) ||
             channel.ref.slot == uint32_t(CommonSlot::Transparency)))
            animated[channel.ref.owner] = true;
    for (size_t i = 0; i < lint.scene.effects.size(); ++i) {
        const Effect& effect = lint.scene.effects[i];
        if (!effect.common || effect.rsl || effect.document != 0) continue;
        check_opacity(lint, effect, animated[i]);
        check_parts(lint, effect);
    }
}

}  // namespace kinora::collada
