// collada/extract/materials.cpp: effects with the profiles that can be rendered, and materials: an
// effect and the parameters they set.
#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

const Element* extra_technique(const Element& owner, std::string_view profile) {
    for (const Element& extra : owner.children()) {
        if (extra.name != "extra") continue;
        for (const Element& technique : extra.children())
            if (technique.name == "technique" && technique.value("profile") == profile)
                return &technique;
    }
    return nullptr;
}

namespace {

void read_setparams(Extraction& x, Link instance, uint32_t material_number, Material& material) {
    const Effect* effect = material.effect == kNone ? nullptr : &x.scene.effects[material.effect];
    for (const Element& child : instance.element->children()) {
        if (child.name != "setparam") continue;
        const Element* value = value_child(child);
        Link link{instance.doc, &child};
        if (!value && effect && set_sampler(x, link, *effect, material)) continue;
        if (!value) {
            const Element* other = child.first_child;
            x.diag.report(Code::FX_VALUE, x.where(link), other ? other->name : child.name);
            continue;
        }
        SetParam set;
        set.ref = child.value("ref");
        set.where = x.where(link);
        if (effect) set.param = find_param(x, *effect, set.ref);
        if (effect && set.param == kNone)
            x.diag.report(Code::FX_PARAM_UNRESOLVED, x.where(link, "ref"), set.ref);
        if (!read_param_value(x, {instance.doc, value}, set.value)) continue;
        TargetRef ref{Owner::MaterialParam, material_number, uint32_t(material.setparams.size()), 0,
                      uint32_t(set.value.numbers.size())};
        x.target_of[&child] = x.target_of[value] = ref;
        material.setparams.push_back(std::move(set));
    }
}

// <extra><technique profile="RSL" target="interior exterior">, or on elements inside it: a word for
// each VOLUME shader.
std::string read_volume_target(const Element& material) {
    const Element* technique = extra_technique(material, "RSL");
    if (!technique) return {};
    std::string targets(technique->value("target"));
    if (!targets.empty()) return targets;
    for (const Element& child : technique->children()) {
        std::string_view target = child.value("target");
        if (!target.empty() && !targets.empty()) targets += ' ';
        targets += target;
    }
    return targets;
}

// <extra><technique profile="RSL"><samples>: of an area light, at each lit point.
uint32_t read_samples(Extraction& x, Link material) {
    constexpr uint64_t kMost = 4096;
    const Element* technique = extra_technique(*material.element, "RSL");
    const Element* samples = technique ? technique->child("samples") : nullptr;
    if (!samples) return 0;
    uint64_t count = 0;
    bool good = parse_count(trim(samples->text), count) && count >= 1 && count <= kMost;
    if (good) return uint32_t(count);
    x.diag.report(Code::LIGHT_SAMPLES, x.where({material.doc, samples}), trim(samples->text),
                  kMost);
    return 0;
}

uint32_t make_material(Extraction& x, Link owner, const Element* instance) {
    auto [at, fresh] = x.made.emplace(owner.element, kNone);
    if (!fresh) return at->second;
    uint32_t& result = at->second;
    if (!x.budget.reserve(sizeof(Material), x.where(owner))) return kNone;
    Material material;
    material.id = owner.element->value("id");
    material.name = owner.element->value("name");
    material.where = x.where(owner);
    material.volume_target = read_volume_target(*owner.element);
    material.samples = read_samples(x, owner);
    material.shadows = read_shadows(*owner.element);
    if (instance) {
        Link link{owner.doc, instance};
        if (Link effect = resolve(x, link, "url", {"effect"}))
            material.effect = effect_index(x, effect);
        read_setparams(x, link, uint32_t(x.scene.materials.size()), material);
    } else {
        x.diag.report(Code::SCHEMA_MISSING_ELEMENT, material.where, "material", "instance_effect");
    }
    return result = append(x.scene.materials, std::move(material));
}

}  // namespace

uint32_t material_index(Extraction& x, Link material) {
    return make_material(x, material, material.element->child("instance_effect"));
}

uint32_t instance_effect_index(Extraction& x, Link instance) {
    return make_material(x, instance, instance.element);
}

std::vector<uint32_t> rsl_extra_materials(Extraction& x, Link owner) {
    std::vector<uint32_t> materials;
    const Element* technique = extra_technique(*owner.element, "RSL");
    if (!technique) return materials;
    for (const Element& child : technique->children()) {
        if (child.name != "instance_effect") continue;
        uint32_t material = instance_effect_index(x, {owner.doc, &child});
        if (material != kNone && x.scene.materials[material].effect != kNone)
            materials.push_back(material);
    }
    return materials;
}

uint32_t effect_index(Extraction& x, Link link) {
    auto [at, fresh] = x.made.emplace(link.element, kNone);
    if (!fresh) return at->second;
    const Element& e = *link.element;
    if (!x.budget.reserve(sizeof(Effect), x.where(link))) return kNone;
    // Nothing below makes another effect, so the number is known before it is added.
    uint32_t number = at->second = uint32_t(x.scene.effects.size());
    Effect effect;
    effect.id = e.value("id");
    effect.name = e.value("name");
    effect.document = link.doc;
    effect.where = x.where(link);
    read_params(x, link, ParamScope::Effect, number, effect);
    for (const Element& child : e.children()) {
        if (child.name == "profile_COMMON" && !effect.common)
            read_common(x, {link.doc, &child}, number, effect);
        if (child.name == "profile_RSL" && !effect.rsl)
            read_rsl(x, {link.doc, &child}, number, effect);
    }
    if (!effect.common && !effect.rsl) x.diag.report(Code::FX_NO_PROFILE, effect.where, effect.id);
    x.scene.effects.push_back(std::move(effect));
    return number;
}

}  // namespace kinora::collada
