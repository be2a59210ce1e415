// collada/extract/black_effects.cpp: effects that would be black, although the file says otherwise.
#include <algorithm>

#include "collada/extract/extract_p.h"

namespace kinora::collada {

namespace {

bool is_lit(const CommonValue& value) {
    if (value.source != SlotSource::Value) return value.source != SlotSource::Absent;
    return std::any_of(value.slot.values.begin(), value.slot.values.begin() + 3,
                       [](double v) { return v > 0; });
}

bool is_black(const CommonShading& common) {
    return !is_lit(common[CommonSlot::Diffuse]) && !is_lit(common[CommonSlot::Emission]) &&
           !(is_lit(common[CommonSlot::Reflective]) && is_lit(common[CommonSlot::Reflectivity]));
}

// By effect: a channel drives one of the colors that are looked at here.
std::vector<bool> moving_colors(const SceneData& scene) {
    std::vector<bool> moving(scene.effects.size(), false);
    for (const Channel& channel : scene.channels) {
        CommonSlot slot = CommonSlot(channel.ref.slot);
        bool color = slot == CommonSlot::Emission || slot == CommonSlot::Ambient ||
                     slot == CommonSlot::Diffuse;
        if (channel.ref.kind == Owner::EffectCommon && color) moving[channel.ref.owner] = true;
    }
    return moving;
}

// A light grey that shows form, as of what has no material: 0.8 on a display.
constexpr double kGrey = 0.9063;

// Where a model says nothing of colors at all.
void give_grey(Extraction& x, Effect& effect) {
    CommonShading& common = *effect.common;
    for (CommonSlot slot : {CommonSlot::Emission, CommonSlot::Ambient, CommonSlot::Diffuse,
                            CommonSlot::Specular, CommonSlot::Reflective})
        if (common[slot].source != SlotSource::Absent) return;
    if (common.model == CommonModel::Constant) common.model = CommonModel::Lambert;
    CommonValue& color = common.slots[size_t(CommonSlot::Diffuse)];
    color.source = SlotSource::Value;
    color.where = common.where;
    color.slot.count = 4;
    std::fill_n(color.slot.values.begin(), 3, kGrey);
    color.slot.values[3] = 1;
    x.diag.report(Code::FX_NO_COLOR, common.where, effect.id);
}

// <constant> has no <diffuse>. Exporters write one.
void take_diffuse_of_constant(Extraction& x, Effect& effect) {
    CommonShading& common = *effect.common;
    const CommonValue& diffuse = common[CommonSlot::Diffuse];
    if (common.model != CommonModel::Constant || !is_lit(diffuse)) return;
    if (is_lit(common[CommonSlot::Emission])) return;
    x.diag.report(Code::FX_CONSTANT_DIFFUSE, diffuse.where, effect.id);
    common.slots[size_t(CommonSlot::Emission)] = diffuse;
}

// `all_black`: every effect of the scene is. Black beside other colors may be meant.
void take_ambient(Extraction& x, Effect& effect, bool all_black) {
    CommonValue& diffuse = effect.common->slots[size_t(CommonSlot::Diffuse)];
    const CommonValue& color = (*effect.common)[CommonSlot::Ambient];
    bool meant = diffuse.source != SlotSource::Absent && !all_black;
    if (meant || !is_lit(color) || !is_black(*effect.common)) return;
    x.diag.report(Code::FX_AMBIENT_ONLY, color.where, effect.id);
    diffuse = color;
}

}  // namespace

void mend_black_effects(Extraction& x) {
    std::vector<bool> moving = moving_colors(x.scene);
    auto ambient = [](const Light& light) { return light.kind == LightKind::Ambient; };
    bool ambient_light = std::ranges::any_of(x.scene.lights, ambient);
    auto shows_color = [](const Effect& e) { return e.rsl || !e.common || !is_black(*e.common); };
    bool all_black = std::ranges::none_of(x.scene.effects, shows_color);
    for (size_t e = 0; e < x.scene.effects.size(); ++e) {
        Effect& effect = x.scene.effects[e];
        if (moving[e] || effect.rsl || !effect.common) continue;
        give_grey(x, effect);
        take_diffuse_of_constant(x, effect);
        if (!ambient_light) take_ambient(x, effect, all_black);
    }
}

}  // namespace kinora::collada
