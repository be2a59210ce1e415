// collada/extract/transparency.cpp: materials whose opacity the specification's formula makes 0.
#include <algorithm>
#include <array>
#include <map>

#include "collada/extract/extract_p.h"

namespace kinora::collada {

namespace {

// Less than half a step of 8 bits is not seen.
constexpr double kLeastOpacity = 0.5 / 255;

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
        if ((zero_hides ? 1 - amount : amount) > kLeastOpacity) return false;
    }
    return true;
}

bool is_animated(const SceneData& scene, uint32_t material_number) {
    const Material& material = scene.materials[material_number];
    const CommonShading& common = *scene.effects[material.effect].common;
    auto of_slots = [&](auto&& says) {
        return says(CommonSlot::Transparent) || says(CommonSlot::Transparency);
    };
    auto reads_param = [&](uint32_t param) {
        return of_slots([&](CommonSlot slot) {
            return common[slot].source == SlotSource::Param && common[slot].param == param;
        });
    };
    return std::any_of(scene.channels.begin(), scene.channels.end(), [&](const Channel& channel) {
        const TargetRef& ref = channel.ref;
        if (ref.kind == Owner::MaterialParam)
            return ref.owner == material_number && reads_param(material.setparams[ref.slot].param);
        if (ref.owner != material.effect) return false;
        if (ref.kind == Owner::EffectParam) return reads_param(ref.slot);
        return ref.kind == Owner::EffectCommon &&
               of_slots([&](CommonSlot slot) { return ref.slot == uint32_t(slot); });
    });
}

// Materials to whose transparency some <bind> gives another number.
std::vector<bool> bound_transparencies(const SceneData& scene) {
    std::vector<bool> bound(scene.materials.size(), false);
    for (const Node& node : scene.nodes)
        for (const MeshInstance& mesh : node.meshes)
            for (const MaterialBinding& binding : mesh.materials)
                for (const ParamBinding& param : binding.params)
                    if (binding.material != kNone && param.semantic.starts_with("transparen"))
                        bound[binding.material] = true;
    return bound;
}

// What is written in numbers lets through some of the light.
std::optional<double> partial_opacity(const SceneData& scene, const Material& material) {
    const CommonShading& common = *scene.effects[material.effect].common;
    if (common[CommonSlot::Transparency].source != SlotSource::Value ||
        common[CommonSlot::Transparent].source != SlotSource::Value)
        return std::nullopt;
    const auto transparency = slot_numbers(scene, material, CommonSlot::Transparency);
    const auto transparent = slot_numbers(scene, material, CommonSlot::Transparent);
    const bool by_alpha = common.opaque == Opaque::AOne || common.opaque == Opaque::AZero;
    const double amount = (*transparency)[0] * (*transparent)[by_alpha ? 3 : 0];
    const bool zero_hides = common.opaque == Opaque::AZero || common.opaque == Opaque::RgbZero;
    const double opacity = zero_hides ? 1 - amount : amount;
    return opacity > kLeastOpacity && opacity < 1 - kLeastOpacity ? std::optional(opacity)
                                                                  : std::nullopt;
}

// An exporter counts the other way if most of a file's transparent materials come out invisible.
void reverse_the_others(Extraction& x, const std::vector<bool>& fixed) {
    struct OfDocument {
        uint32_t invisible = 0, partial = 0;
    };
    std::map<uint32_t, OfDocument> counts;
    auto document_of = [&](const Material& m) { return x.scene.effects[m.effect].document; };
    auto partial = [&](uint32_t m) -> std::optional<double> {
        const Material& material = x.scene.materials[m];
        if (material.effect == kNone || !x.scene.effects[material.effect].common || !fixed[m])
            return std::nullopt;
        return partial_opacity(x.scene, material);
    };
    for (uint32_t m = 0; m < x.scene.materials.size(); ++m) {
        const Material& material = x.scene.materials[m];
        if (material.effect == kNone) continue;
        OfDocument& count = counts[document_of(material)];
        count.invisible += material.invisible;
        count.partial += partial(m).has_value();
    }
    for (uint32_t m = 0; m < x.scene.materials.size(); ++m) {
        Material& material = x.scene.materials[m];
        const std::optional<double> opacity = partial(m);
        if (!opacity) continue;
        const OfDocument& count = counts[document_of(material)];
        if (count.invisible <= count.partial) continue;
        material.reversed = true;
        x.diag.report(Code::FX_TRANSPARENT_REVERSED,
                      (*x.scene.effects[material.effect].common)[CommonSlot::Transparency].where,
                      material.id.empty() ? material.name : material.id, 1 - *opacity);
    }
}

}  // namespace

void check_transparency(Extraction& x) {
    std::vector<bool> bound = bound_transparencies(x.scene);
    std::vector<bool> fixed(x.scene.materials.size(), false);  // to what the effect says
    for (uint32_t m = 0; m < x.scene.materials.size(); ++m) {
        Material& material = x.scene.materials[m];
        if (material.effect == kNone || !x.scene.effects[material.effect].common) continue;
        const Effect& effect = x.scene.effects[material.effect];
        if (effect.rsl || bound[m] || is_animated(x.scene, m)) continue;
        fixed[m] = true;
        if (!invisible(x.scene, material)) continue;
        material.invisible = true;
        const CommonValue& transparent = (*effect.common)[CommonSlot::Transparent];
        bool written = transparent.source != SlotSource::Absent;
        x.diag.report(Code::FX_TRANSPARENT_ALL, written ? transparent.where : effect.common->where,
                      material.id.empty() ? material.name : material.id,
                      kOpaque[size_t(effect.common->opaque)]);
    }
    reverse_the_others(x, fixed);
}

}  // namespace kinora::collada
