// collada/extract/common.cpp: profile_COMMON: a shading model and its slots.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "collada/document/element_numbers_p.h"
#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"
#include "runtime/base/numbers.h"

namespace kinora::collada {

namespace {

struct ModelRow {
    std::string_view name;
    CommonModel model;
};
constexpr ModelRow kModels[] = {{"constant", CommonModel::Constant},
                                {"lambert", CommonModel::Lambert},
                                {"phong", CommonModel::Phong},
                                {"blinn", CommonModel::Blinn}};

struct SlotRow {
    std::string_view name;
    CommonSlot slot;
};
constexpr SlotRow kSlots[] = {{"emission", CommonSlot::Emission},
                              {"ambient", CommonSlot::Ambient},
                              {"diffuse", CommonSlot::Diffuse},
                              {"specular", CommonSlot::Specular},
                              {"shininess", CommonSlot::Shininess},
                              {"reflective", CommonSlot::Reflective},
                              {"reflectivity", CommonSlot::Reflectivity},
                              {"transparent", CommonSlot::Transparent},
                              {"transparency", CommonSlot::Transparency},
                              {"index_of_refraction", CommonSlot::IndexOfRefraction}};

struct OpaqueRow {
    std::string_view name;
    Opaque opaque;
};
constexpr OpaqueRow kOpaque[] = {{"A_ONE", Opaque::AOne},
                                 {"RGB_ZERO", Opaque::RgbZero},
                                 {"A_ZERO", Opaque::AZero},
                                 {"RGB_ONE", Opaque::RgbOne}};

// A colour is four numbers (alpha 1 where it is left out), a <float> one.
void read_value(Extraction& x, Link link, TargetRef ref, CommonValue& value) {
    std::vector<double> numbers = read_doubles(x.document(link.doc), *link.element, x.diag);
    bool color = link.element->name == "color";
    size_t wanted = color ? 4 : 1;
    if (color && numbers.size() == 3) numbers.push_back(1);
    if (numbers.empty()) return;
    numbers.resize(wanted, 1.0);  // check_elements reports another count
    value.source = SlotSource::Value;
    value.slot.sid = link.element->value("sid");
    value.slot.where = x.where(link);
    value.slot.count = uint8_t(wanted);
    for (size_t i = 0; i < wanted; ++i)
        value.slot.values[i] = std::isfinite(numbers[i]) ? numbers[i] : 0;
    ref.count = uint32_t(wanted);
    x.target_of[link.element] = ref;
    x.target_of.emplace(link.element->parent, ref);
}

void read_texture(Extraction& x, Link link, Effect& effect, CommonValue& value) {
    value.sampler = texture_sampler(x, link, effect);
    if (value.sampler == kNone) return;
    value.source = SlotSource::Texture;
    value.texcoord = link.element->value("texcoord");
    if (value.texcoord.empty()) x.diag.report(Code::TEX_NO_TEXCOORD, x.where(link));
}

CommonValue read_slot_value(Extraction& x, Link link, TargetRef ref, Effect& effect) {
    CommonValue value;
    value.where = x.where(link);
    for (const Element& child : link.element->children()) {
        Link part{link.doc, &child};
        if (child.name == "color" || child.name == "float") {
            read_value(x, part, ref, value);
        } else if (child.name == "texture") {
            read_texture(x, part, effect, value);
        } else if (child.name == "param") {
            std::string_view name = child.value("ref");
            value.param = find_param(x, effect, name);
            if (value.param == kNone)
                x.diag.report(Code::FX_PARAM_UNRESOLVED, x.where(part, "ref"), name);
            else
                value.source = SlotSource::Param;
        }
        if (value.source != SlotSource::Absent) break;
    }
    return value;
}

// How much a map bends: <amount> in the texture's own extra (MAX3D), or beside it.
double read_bump_amount(const Element& bump) {
    double amount = 1;
    const Element* texture = bump.child("texture");
    for (const Element* owner : {texture, &bump})
        if (owner)
            for (const Element& extra : owner->children())
                for (const Element& technique : extra.children())
                    if (const Element* e = technique.child("amount")) parse_double(e->text, amount);
    return std::isfinite(amount) ? amount : 1;
}

void read_bump(Extraction& x, Link bump, CommonShading& common, Effect& effect) {
    CommonValue& slot = common.slots[size_t(CommonSlot::Bump)];
    if (slot.source != SlotSource::Absent) return;
    slot = read_slot_value(x, bump, {}, effect);
    std::string_view kind = bump.element->value("bumptype");
    common.bump_is_normals = kind == "NORMALMAP" || bump.element->name != "bump";
    common.bump_amount = read_bump_amount(*bump.element);
}

// <double_sided>, <bump> and maps of normals in the extras of an element, whatever the vendor.
void read_extras(Extraction& x, Link owner, CommonShading& common, Effect& effect) {
    for (const Element& extra : owner.element->children()) {
        if (extra.name != "extra") continue;
        for (const Element& technique : extra.children()) {
            if (const Element* flag = technique.child("double_sided"))
                common.double_sided = parse_bool(flag->text).value_or(true);
            for (std::string_view name : {"bump", "normalmap", "normal"})
                if (const Element* bump = technique.child(name))
                    if (bump->child("texture")) read_bump(x, {owner.doc, bump}, common, effect);
        }
    }
}

}  // namespace

std::optional<int> blender_version(std::string_view tool) {
    constexpr std::string_view kName = "Blender ";
    int version[2];
    if (!tool.starts_with(kName)) return std::nullopt;
    tool.remove_prefix(kName.size());
    if (!take_numbers<int>(tool, '.', version)) return std::nullopt;
    return 100 * std::min(version[0], 99) + version[1];
}

namespace {

// Blender wrote its "emit" as a grey <emission> until 2.79: its renderer added so many times the
// diffuse color. Since 2.80 it writes the color that is emitted. Other exporters for Blender
// (their tools' names begin otherwise) multiply by the diffuse color themselves.
bool wrote_emit(std::string_view tool) {
    if (const auto version = blender_version(tool)) return *version < kBlenderWatts;
    return tool.starts_with("Blender v:2") || tool.starts_with("Illusoft Collada");
}

bool is_grey(const CommonValue& value) {
    const auto& v = value.slot.values;
    return value.source == SlotSource::Value && v[0] == v[1] && v[1] == v[2];
}

// Exponents of highlights are 1 and more; below that it is a share of 128.
void mend_shininess(Extraction& x, CommonShading& common) {
    constexpr double kMost = 128;
    CommonValue& value = common.slots[size_t(CommonSlot::Shininess)];
    double& shininess = value.slot.values[0];
    if (value.source != SlotSource::Value || !(shininess > 0 && shininess < 1)) return;
    x.diag.report(Code::FX_SHININESS, value.where, shininess, kMost * shininess);
    shininess *= kMost;
}

void read_opaque(Link transparent, CommonShading& common) {
    const Attribute* a = transparent.element->attribute("opaque");
    if (!a) return;
    for (const OpaqueRow& row : kOpaque)
        if (row.name == a->value) {
            common.opaque = row.opaque;
            return;
        }
}

}  // namespace

void read_common(Extraction& x, Link profile, uint32_t effect_number, Effect& effect) {
    read_params(x, profile, ParamScope::ProfileCommon, effect_number, effect);
    const Element* technique = profile.element->child("technique");
    const Element* model = nullptr;
    CommonShading common;
    for (const ModelRow& row : kModels)
        if (const Element* found = technique && !model ? technique->child(row.name) : nullptr) {
            model = found;
            common.model = row.model;
        }
    if (!model) {
        x.diag.report(Code::FX_NO_SHADING,
                      x.where({profile.doc, technique ? technique : profile.element}));
        return;
    }
    read_params(x, {profile.doc, technique}, ParamScope::Technique, effect_number, effect);
    common.technique_sid = technique->value("sid");
    common.where = x.where({profile.doc, model});
    for (const SlotRow& row : kSlots) {
        const Element* slot = model->child(row.name);
        if (!slot) continue;
        TargetRef ref{Owner::EffectCommon, effect_number, uint32_t(row.slot)};
        common.slots[size_t(row.slot)] = read_slot_value(x, {profile.doc, slot}, ref, effect);
        if (row.slot == CommonSlot::Transparent) read_opaque({profile.doc, slot}, common);
    }
    mend_shininess(x, common);
    common.emission_is_factor = common.model != CommonModel::Constant &&
                                is_grey(common[CommonSlot::Emission]) &&
                                wrote_emit(authoring_tool(x.document(profile.doc)));
    for (const Element* owner : {profile.element->parent, profile.element, technique, model})
        if (owner) read_extras(x, {profile.doc, owner}, common, effect);
    effect.common = std::move(common);
}

}  // namespace kinora::collada
