// collada/extract/effects.cpp: <effect>: its parameters and the profiles that can be rendered.
#include "collada/extract/extract_p.h"

namespace kinora::collada {

uint32_t effect_index(Extraction& x, Link link) {
    auto [at, fresh] = x.made.emplace(link.element, kNone);
    if (!fresh) return at->second;
    const Element& e = *link.element;
    if (!reserve_memory(x, sizeof(Effect), x.where(link))) return kNone;
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
