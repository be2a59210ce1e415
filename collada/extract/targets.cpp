// collada/extract/targets.cpp: "id/sid/sid.MEMBER", "(i)" and "(i)(j)" name part of a value.
#include <cctype>

#include "collada/extract/targets_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

struct Member {
    std::string_view name;
    uint32_t component;
};
constexpr Member kMembers[] = {{"X", 0}, {"Y", 1}, {"Z", 2}, {"W", 3}, {"R", 0},
                               {"G", 1}, {"B", 2}, {"A", 3}, {"U", 0}, {"V", 1},
                               {"S", 0}, {"T", 1}, {"P", 2}, {"Q", 3}};

// "sid.X" -> "sid", ".X"; "sid(1)(2)" -> "sid", "(1)(2)".
void split_selector(std::string_view segment, std::string_view& name, std::string_view& selector) {
    size_t cut = segment.ends_with(')') ? segment.find('(') : segment.find_last_of('.');
    name = segment.substr(0, cut);
    selector = cut == segment.npos ? std::string_view{} : segment.substr(cut);
}

// Members are written in capitals; some exporters do not.
std::string capital(std::string_view member) {
    std::string name(member);
    for (char& c : name) c = char(std::toupper(uint8_t(c)));
    return name;
}

// "(3)(0)" -> {3, 0}.
std::vector<uint64_t> indices_of(std::string_view selector) {
    std::vector<uint64_t> indices;
    while (selector.starts_with('(')) {
        size_t close = selector.find(')');
        uint64_t value = 0;
        if (close == selector.npos || !parse_count(selector.substr(1, close - 1), value)) return {};
        indices.push_back(value);
        selector.remove_prefix(close + 1);
    }
    return indices;
}

}  // namespace

const Element* TargetResolver::find_sid(const Element& scope, std::string_view sid) {
    constexpr int kQuick = 64;  // most targets are a node's own transforms
    int tried = 0;
    for (const Element& child : scope.children()) {
        if (child.value("sid") == sid) return &child;
        if (++tried == kQuick) break;
    }
    auto [at, fresh] = sids_.try_emplace(&scope);
    if (fresh) {
        std::vector<const Element*> queue{&scope};
        for (size_t i = 0; i < queue.size(); ++i)  // breadth first, as the specification asks
            for (const Element& child : queue[i]->children()) {
                if (child.attribute("sid")) at->second.emplace(child.value("sid"), &child);
                queue.push_back(&child);
            }
    }
    auto found = at->second.find(sid);
    return found == at->second.end() ? nullptr : found->second;
}

// Exporters' short forms name the element itself: "effect/diffuse", "camera/xfov".
const Element* TargetResolver::find_named(const Element& root, const Element& scope,
                                          std::string_view name) {
    bool deep = root.name == "effect" || root.name == "light" || root.name == "camera" ||
                root.name == "controller";
    if (!deep && scope.name != "node") return nullptr;
    auto [at, fresh] = named_.try_emplace(&scope);
    std::vector<const Element*> queue;
    if (fresh) queue.push_back(&scope);
    for (size_t i = 0; i < queue.size(); ++i)
        for (const Element& child : queue[i]->children()) {
            if (x_.target_of.count(&child)) at->second.emplace(child.name, &child);
            if (deep) queue.push_back(&child);
        }
    // what only leads to one: "effect/phong/diffuse/sid", "effect/profile_COMMON/common/sid"
    for (size_t i = 1; i < queue.size(); ++i) at->second.emplace(queue[i]->name, queue[i]);
    auto found = at->second.find(name);
    return found == at->second.end() ? nullptr : found->second;
}

// material-id/ref: the setparam of that ref; made from the effect's value when there is none.
TargetRef TargetResolver::material_param(const Element& material, std::string_view ref) {
    auto made = x_.made.find(&material);
    if (made == x_.made.end() || made->second == kNone) return {};
    uint32_t number = made->second;
    Material& m = x_.scene.materials[number];
    NameIndex& index = x_.setparams_of_material[number];
    for (; index.known < m.setparams.size(); ++index.known)
        index.at.try_emplace(m.setparams[index.known].ref, uint32_t(index.known));
    auto found = index.at.find(std::string(ref));
    uint32_t slot = found == index.at.end() ? uint32_t(m.setparams.size()) : found->second;
    if (slot == m.setparams.size()) {
        if (m.effect == kNone) return {};
        const Effect& effect = x_.scene.effects[m.effect];
        uint32_t param = find_param(x_, effect, ref);
        if (param == kNone) return {};
        m.setparams.push_back({std::string(ref), param, effect.params[param].value, m.where});
    }
    return {Owner::MaterialParam, number, slot, 0,
            uint32_t(m.setparams[slot].value.numbers.size())};
}

const Slot* TargetResolver::slot_of(const TargetRef& ref) const {
    switch (ref.kind) {
        case Owner::Transform:
            return &x_.scene.nodes[ref.owner].transforms[ref.slot].slot;
        case Owner::Light:
            return &x_.scene.lights[ref.owner].slots[ref.slot];
        case Owner::Camera:
            return &x_.scene.cameras[ref.owner].slots[ref.slot];
        case Owner::EffectCommon:
            return &x_.scene.effects[ref.owner].common->slots[ref.slot].slot;
        case Owner::None:
        case Owner::EffectParam:
        case Owner::MaterialParam:
        case Owner::MorphWeight:
            break;
    }
    return nullptr;
}

const char* TargetResolver::apply_index(std::string_view selector, TargetRef& ref) const {
    std::vector<uint64_t> indices = indices_of(selector);
    if (indices.empty() || indices.size() > 2) return "its index is no number";
    bool transform = ref.kind == Owner::Transform;
    TransformKind kind =
        transform ? x_.scene.nodes[ref.owner].transforms[ref.slot].kind : TransformKind::Translate;
    bool matrix = transform && kind == TransformKind::Matrix;
    bool param = ref.kind == Owner::EffectParam || ref.kind == Owner::MaterialParam;
    bool rows = param && ref.count == 16;  // a <float4x4>, as written
    uint64_t width = matrix || rows ? 4 : 3;
    for (uint64_t i : indices)
        if (i >= ref.count || (indices.size() == 2 && i >= width))
            return "its index is out of range";
    uint64_t component = indices[0];
    if (indices.size() == 2 && rows)
        component = indices[1] * width + indices[0];
    else if (indices.size() == 2)
        component = indices[0] * width + indices[1];  // (column)(row), as stored
    else if (matrix)
        component = indices[0] % 4 * 4 + indices[0] / 4;  // (i) counts as the file does, by rows
    if (component >= ref.count) return "its index is out of range";
    ref.first = uint32_t(component);
    ref.count = 1;
    return nullptr;
}

const char* TargetResolver::apply_member(std::string_view written, TargetRef& ref) const {
    std::string name = capital(written);
    uint32_t component = UINT32_MAX;
    for (const Member& m : kMembers)
        if (m.name == name) component = m.component;
    if (name == "ANGLE" && ref.kind == Owner::Transform) {
        TransformKind kind = x_.scene.nodes[ref.owner].transforms[ref.slot].kind;
        if (kind == TransformKind::Rotate) component = 3;
        if (kind == TransformKind::Skew) component = 0;
    }
    if (ref.count == 1 && component >= 1) component = 0;  // a single number by any name
    if (component == UINT32_MAX) return "the value has no such member";
    if (component >= ref.count) return "the value has fewer components";
    ref.first = component;
    ref.count = 1;
    return nullptr;
}

// No selector: the whole value, fitted to what the sampler brings.
void TargetResolver::apply_whole(uint32_t stride, TargetRef& ref) const {
    if (ref.kind == Owner::Transform) {
        TransformKind kind = x_.scene.nodes[ref.owner].transforms[ref.slot].kind;
        ref.whole_matrix = kind == TransformKind::Matrix && stride != 1;
        if (kind == TransformKind::Rotate && stride == 1) ref.first = 3, ref.count = 1;
    }
    bool rgb = ref.kind == Owner::EffectCommon && ref.count == 4 && stride == 3;
    if (rgb) ref.count = 3;
}

const char* TargetResolver::apply_selector(std::string_view selector, uint32_t stride,
                                           TargetRef& ref) const {
    const char* fault = nullptr;
    if (selector.empty())
        apply_whole(stride, ref);
    else if (selector.starts_with('('))
        fault = apply_index(selector, ref);
    else
        fault = apply_member(selector.substr(1), ref);
    if (fault || ref.kind != Owner::MorphWeight) return fault;
    auto remap = x_.morph_remap.find(ref.owner);
    if (remap == x_.morph_remap.end()) return nullptr;
    uint32_t kept = ref.count == 1 ? remap->second[ref.first] : kNone;
    ref.first = kept;
    return kept == kNone ? "its morph target was left out" : nullptr;
}

bool TargetResolver::is_reached(const Element* element) const {
    for (; element; element = element->parent) {
        auto made = x_.made.find(element);
        if (made != x_.made.end()) return made->second != kNone;
    }
    return false;
}

// A source of morph weights has an id and no sid: "controller/weights(0)".
const Element* TargetResolver::find_below(const Element& scope, uint32_t doc,
                                          std::string_view id) const {
    const Element* found = x_.document(doc).find(id);
    if (!found || !x_.target_of.count(found)) return nullptr;
    for (const Element* e = found->parent; e; e = e->parent)
        if (e == &scope) return found;
    return nullptr;
}

TargetResolver::Found TargetResolver::find(const Element& root, uint32_t doc,
                                           const std::vector<std::string_view>& path) {
    const Element* at = &root;
    for (size_t i = 0; i + 1 < path.size() && at; ++i) {
        const Element* next = find_sid(*at, path[i]);
        if (!next) next = find_named(root, *at, path[i]);
        at = next;
    }
    if (!at) return {};
    if (path.empty()) return {at, {}, {}};
    std::string_view name, selector;
    split_selector(path.back(), name, selector);
    struct {
        std::string_view name, selector;
    } readings[] = {{path.back(), {}}, {name, selector}};
    for (auto& reading : readings) {
        if (root.name == "material" && path.size() == 1) {
            TargetRef ref = material_param(root, reading.name);
            if (ref.kind != Owner::None) return {&root, reading.selector, ref};
        }
        const Element* found = find_sid(*at, reading.name);
        if (!found || !x_.target_of.count(found))
            if (const Element* named = find_named(root, *at, reading.name);
                named && x_.target_of.count(named))
                found = named;
        if (!found) found = find_below(*at, doc, reading.name);
        if (found) return {found, reading.selector, {}};
    }
    return {};
}

// Blender (2.8 on) writes a camera's or light's target as "Name-id/xfov". What is one word too long
// in front still means one thing.
const Element* TargetResolver::named_twice(uint32_t doc, std::string_view id,
                                           Location where) const {
    constexpr int kMostWords = 8;
    std::string_view written = id;
    for (int word = 0; word < kMostWords && id.find('-') != id.npos; ++word) {
        std::string_view shorter = id.substr(id.find('-') + 1);
        const Element* e = x_.document(doc).find(shorter);
        if (e && (e->name == "camera" || e->name == "light")) {
            x_.diag.report(Code::ANIM_TARGET_FALLBACK, where, written, shorter);
            return e;
        }
        id = shorter;
    }
    return nullptr;
}

TargetRef TargetResolver::resolve(uint32_t doc, std::string_view target, Location where,
                                  uint32_t stride, const FindingInfo& unresolved) {
    std::string_view rest = trim(target), selector;
    if (rest.starts_with('#')) rest.remove_prefix(1);
    std::vector<std::string_view> path;
    size_t slash = rest.find('/');
    std::string_view id = rest.substr(0, slash);
    while (slash != rest.npos && path.size() < 64) {
        rest.remove_prefix(slash + 1);
        slash = rest.find('/');
        path.push_back(rest.substr(0, slash));
    }
    const Element* root = x_.document(doc).find(id);
    if (!root && path.empty()) {
        split_selector(id, id, selector);
        root = x_.document(doc).find(id);
    }
    if (!root) root = named_twice(doc, id, where);
    Found found;
    size_t tried = 0;
    for (const Element* e = root; e && tried < kMostSameId; e = e->next_same_id, ++tried) {
        Found here = find(*e, doc, path);
        if (!here.element) continue;
        if (!found.element) found = here;
        if (here.ref.kind != Owner::None || x_.target_of.count(here.element)) {
            found = here;
            break;
        }
    }
    if (!found.element) {
        x_.diag.report(unresolved, where, target);
        return {};
    }
    if (selector.empty()) selector = found.selector;
    TargetRef ref = found.ref;
    if (ref.kind == Owner::None) {
        auto known = x_.target_of.find(found.element);
        if (known != x_.target_of.end()) ref = known->second;
    }
    const Slot* slot = ref.kind == Owner::None ? nullptr : slot_of(ref);
    bool nothing = ref.kind == Owner::None || ref.count == 0 || (slot && slot->count < ref.count);
    if (nothing) {
        if (found.element->name == "visibility") x_.moving_visibility.insert(found.element);
        if (is_reached(found.element)) x_.diag.report(Code::ANIM_TARGET_UNSUPPORTED, where, target);
        return {};
    }
    if (const char* fault = apply_selector(selector, stride, ref)) {
        x_.diag.report(Code::ANIM_TARGET_MEMBER, where, target, fault);
        return {};
    }
    if (std::string proper = capital(selector); proper != selector) {
        size_t before = target.rfind(selector);
        x_.diag.report(Code::ANIM_TARGET_FALLBACK, where, target,
                       std::string(target.substr(0, before)) + proper);
    }
    return ref;
}

}  // namespace kinora::collada
