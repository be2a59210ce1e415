// collada/extract/transparency.cpp: materials whose opacity the specification's formula makes 0.
#include <algorithm>
#include <array>

#include "collada/extract/extract_p.h"

namespace kinora::collada {

namespace {

constexpr const char* kOpaque[] = {"A_ONE", "RGB_ZERO", "A_ZERO", "RGB_ONE"};  // by Opaque

// The numbers of a slot for one material; nothing when a texture gives them.
std::optional<std::array<double, 4>> slot_numbers(const SceneData& scene, const Material& material,
                                                  CommonSlot slot) {
    const Effect& effect = scene.effects[material.effect];
    const CommonValue& value = (*effect.common)[slot];
    std::array<double, 4> numbers{1, 1, 1, 1};  // COLLADA 1.4.1, chapter 7: what absence means
    if (value.source == SlotSource::Texture) return std::nullopt;
    if (value.source == SlotSource::Value)
        std::copy_n(value.slot.values.begin(), value.slot.count, numbers.begin());
    if (value.source == SlotSource::Param) {
        const std::vector<double>* given = &effect.params[value.param].value.numbers;
        for (const SetParam& set : material.setparams)
            if (set.param == value.param) given = &set.value.numbers;
        std::copy_n(given->begin(), std::min<size_t>(given->size(), 4), numbers.begin());
    }
    return numbers;
}

// COLLADA 1.4.1, chapter 7, transparent: opacity is transparency times alpha or colour, or 1 minus
// that.
bool invisible(const SceneData& scene, const Material& material) {
    const CommonShading& common = *scene.effects[material.effect].common;
    bool silent = common[CommonSlot::Transparent].source == SlotSource::Absent &&
                  common[CommonSlot::Transparency].source == SlotSource::Absent;
    auto transparency = slot_numbers(scene, material, CommonSlot::Transparency);
    auto transparent = slot_numbers(scene, material, CommonSlot::Transparent);
    if (silent || !transparency) return false;
    bool by_alpha = common.opaque == Opaque::AOne || common.opaque == Opaque::AZero;
    bool zero_hides = common.opaque == Opaque::AZero || common.opaque == Opaque::RgbZero;
    double scale = (*transparency)[0];
    if (!transparent) return !zero_hides && scale == 0;  // whatever the texture holds
    for (size_t k = by_alpha ? 3 : 0; k < (by_alpha ? 4u : 3u); ++k) {
        double amount = scale * (*transparent)[k];
        if ((zero_hides ? 1 - amount : amount) > 1e-6) return false;
    }
    return true;
}

bool is_animated(const SceneData& scene, uint32_t material_number) {
    const Material& material = scene.materials[material_number];
    return std::any_of(scene.channels.begin(), scene.channels.end(), [&](const Channel& channel) {
        const TargetRef& ref = channel.ref;
        if (ref.kind == Owner::MaterialParam) return ref.owner == material_number;
        if (ref.kind == Owner::EffectParam) return ref.owner == material.effect;
        return ref.kind == Owner::EffectCommon && ref.owner == material.effect &&
               (ref.slot == uint32_t(CommonSlot::Transparent) ||
                ref.slot == uint32_t(CommonSlot::Transparency));
    });
}

}  // namespace

void check_transparency(Extraction& x) {
    std::vector<bool> said(x.scene.effects.size(), false);
    for (uint32_t m = 0; m < x.scene.materials.size(); ++m) {
        Material& material = x.scene.materials[m];
        if (material.effect == kNone || !x.scene.effects[material.effect].common) continue;
        const Effect& effect = x.scene.effects[material.effect];
        if (effect.rsl || !invisible(x.scene, material) || is_animated(x.scene, m)) continue;
        material.invisible = true;
        const CommonValue& transparent = (*effect.common)[CommonSlot::Transparent];
        bool written = transparent.source != SlotSource::Absent;
        if (!said[material.effect])
            x.diag.report(Code::FX_TRANSPARENT_ALL,
                          written ? transparent.where : effect.common->where, effect.id,
                          kOpaque[size_t(effect.common->opaque)]);
        said[material.effect] = true;
    }
}

}  // namespace kinora::collada
