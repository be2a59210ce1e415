// collada/extract/samplers.cpp: from a <texture> through sampler and surface to an image.
#include <cmath>

#include "collada/document/element_numbers_p.h"
#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

template <class T>
struct Word {
    std::string_view word;
    T value;
};

constexpr Word<Wrap> kWraps[] = {{"WRAP", Wrap::Wrap},   {"MIRROR", Wrap::Mirror},
                                 {"CLAMP", Wrap::Clamp}, {"BORDER", Wrap::Border},
                                 {"NONE", Wrap::None},   {"MIRROR_ONCE", Wrap::Mirror}};

struct FilterWord {
    std::string_view word;
    Filter filter, mip;  // 1.4 puts the mip filter into the minfilter's name
};
constexpr FilterWord kFilters[] = {{"NONE", Filter::None, Filter::None},
                                   {"NEAREST", Filter::Nearest, Filter::None},
                                   {"LINEAR", Filter::Linear, Filter::None},
                                   {"ANISOTROPIC", Filter::Linear, Filter::Linear},
                                   {"NEAREST_MIPMAP_NEAREST", Filter::Nearest, Filter::Nearest},
                                   {"LINEAR_MIPMAP_NEAREST", Filter::Linear, Filter::Nearest},
                                   {"NEAREST_MIPMAP_LINEAR", Filter::Nearest, Filter::Linear},
                                   {"LINEAR_MIPMAP_LINEAR", Filter::Linear, Filter::Linear}};

void read_wrap(Link sampler, std::string_view name, Wrap& wrap) {
    const Element* e = sampler.element->child(name);
    if (!e) return;
    for (const Word<Wrap>& row : kWraps)
        if (row.word == trim(e->text)) {
            wrap = row.value;
            return;
        }
}

const FilterWord* read_filter(Link sampler, std::string_view name) {
    const Element* e = sampler.element->child(name);
    if (!e) return nullptr;
    for (const FilterWord& row : kFilters)
        if (row.word == trim(e->text)) return &row;
    return nullptr;
}

void read_sampler_state(Extraction& x, Link link, TextureSampler& sampler) {
    read_wrap(link, "wrap_s", sampler.wrap_s);
    read_wrap(link, "wrap_t", sampler.wrap_t);
    bool mips_apart = x.document(link.doc).version() == Version::V1_5_0;
    if (const FilterWord* row = read_filter(link, "minfilter")) {
        sampler.min = row->filter == Filter::None ? Filter::Linear : row->filter;
        if (row->filter != Filter::None && !mips_apart) sampler.mip = row->mip;
    }
    if (const FilterWord* row = read_filter(link, "magfilter"))
        if (row->filter != Filter::None) sampler.mag = row->filter;
    // 1.4 has it for mip maps made elsewhere: there NONE, its default, says nothing.
    if (const FilterWord* row = read_filter(link, "mipfilter"))
        if (row->filter != Filter::None || mips_apart) sampler.mip = row->filter;
    for (std::string_view name : {"mipmap_bias", "mip_bias"}) {
        double bias = 0;
        const Element* e = link.element->child(name);
        if (e && parse_double(e->text, bias) && std::abs(bias) <= 64)
            sampler.mip_bias = float(bias);
    }
    for (std::string_view name : {"mipmap_maxlevel", "mip_max_level"}) {
        uint64_t level = 0;
        const Element* e = link.element->child(name);
        if (e && parse_count(trim(e->text), level) && level <= 255)
            sampler.mip_max_level = uint8_t(level);
    }
    if (const Element* border = link.element->child("border_color")) {
        std::vector<double> c = read_doubles(x.document(link.doc), *border, x.diag);
        for (size_t i = 0; i < c.size() && i < 4; ++i) sampler.border_color[int(i)] = float(c[i]);
    }
}

// MAYA's placement of a texture; other exporters write the same names.
void read_placement(const Element& texture, TextureSampler& sampler) {
    for (const Element& extra : texture.children()) {
        if (extra.name != "extra") continue;
        for (const Element& technique : extra.children()) {
            auto number = [&](std::string_view name, float& out) {
                double value = 0;
                const Element* e = technique.child(name);
                if (e && parse_double(e->text, value)) out = float(value);
            };
            auto flag = [&](std::string_view name, bool& out) {
                const Element* e = technique.child(name);
                if (!e) return false;
                out = parse_bool(e->text).value_or(false);
                return true;
            };
            number("repeatU", sampler.repeat.x);
            number("repeatV", sampler.repeat.y);
            number("offsetU", sampler.offset.x);
            number("offsetV", sampler.offset.y);
            float turn = 0;
            number("rotateUV", turn);
            if (turn != 0) sampler.turn_degrees = double(turn);
            bool wrap = true, mirror = false;
            if (flag("wrapU", wrap)) sampler.wrap_s = wrap ? Wrap::Wrap : Wrap::Clamp;
            if (flag("wrapV", wrap)) sampler.wrap_t = wrap ? Wrap::Wrap : Wrap::Clamp;
            if (flag("mirrorU", mirror) && mirror) sampler.wrap_s = Wrap::Mirror;
            if (flag("mirrorV", mirror) && mirror) sampler.wrap_t = Wrap::Mirror;
        }
    }
}

uint32_t image_by_id(Extraction& x, uint32_t doc, std::string_view id) {
    const Element* image = find_kind(x.document(doc), id, {"image"});
    return image ? image_index(x, {doc, image}) : kNone;
}

// The image of a sampler or surface <newparam>; `depth` guards against loops.
uint32_t image_of_param(Extraction& x, Link param, TextureSampler& sampler, int depth = 0) {
    if (depth > 4) return kNone;
    for (const Element& value : param.element->children()) {
        Link link{param.doc, &value};
        bool is_sampler = value.name.starts_with("sampler");
        if (!is_sampler && value.name != "surface") continue;
        if (is_sampler) read_sampler_state(x, link, sampler);
        if (const Element* instance = value.child("instance_image")) {
            Link image = resolve(x, {param.doc, instance}, "url", {"image"});
            return image ? image_index(x, image) : kNone;
        }
        if (const Element* from = value.child("init_from"))
            return image_by_id(x, param.doc, trim(from->text));
        // 1.4's other ways to fill a surface: the whole, the first level or a face of it
        for (std::string_view init : {"init_planar", "init_cube", "init_volume"})
            if (const Element* from = value.child(init); from && from->first_child)
                return image_by_id(x, param.doc, trim(from->first_child->value("ref")));
        const Element* source = value.child("source");
        if (!source) return kNone;
        if (is_sampler) sampler.surface = trim(source->text);
        const Element* surface = x.newparams.find(value, trim(source->text));
        if (surface) return image_of_param(x, {param.doc, surface}, sampler, depth + 1);
        return image_by_id(x, param.doc, trim(source->text));
    }
    return kNone;
}

void add_newparams(const Element& scope,
                   std::unordered_map<std::string_view, const Element*>& table) {
    for (const Element& child : scope.children())
        if (child.name == "newparam") table.try_emplace(child.value("sid"), &child);
}

}  // namespace

const Element* NewParams::find(const Element& from, std::string_view sid) {
    for (const Element* scope = from.parent; scope; scope = scope->parent) {
        auto [table, fresh] = of_.try_emplace(scope);
        if (fresh) add_newparams(*scope, table->second);
        auto found = table->second.find(sid);
        if (found != table->second.end()) return found->second;
        if (scope->name != "effect") continue;
        // Out of scope, but exporters declare a surface further in than its sampler.
        auto [inner, unseen] = inside_.try_emplace(scope);
        for (const Element* profile = unseen ? scope->first_child : nullptr; profile;
             profile = profile->next)
            add_newparams(*profile, inner->second);
        found = inner->second.find(sid);
        return found == inner->second.end() ? nullptr : found->second;
    }
    return nullptr;
}

uint32_t texture_sampler(Extraction& x, Link texture, Effect& effect) {
    std::string_view name = texture.element->value("texture");
    TextureSampler sampler;
    sampler.sid = name;
    sampler.where = x.where(texture);
    if (const Element* param = x.newparams.find(*texture.element, name)) {
        sampler.image = image_of_param(x, {texture.doc, param}, sampler);
    } else {
        sampler.image = image_called(x, texture.doc, name);
        const FindingInfo* code = &Code::TEX_DIRECT_IMAGE;
        if (sampler.image == kNone) {
            sampler.image = file_image(x, texture, name);
            code = &Code::TEX_DIRECT_FILE;
        }
        if (sampler.image != kNone) x.diag.report(*code, x.where(texture, "texture"), name);
    }
    if (sampler.image == kNone) {
        x.diag.report(Code::TEX_UNRESOLVED, x.where(texture, "texture"), name);
        return kNone;
    }
    read_placement(*texture.element, sampler);
    return append(effect.samplers, std::move(sampler));
}

namespace {

// The material's own sampler `number` of its effect, to be changed.
TextureSampler* own_sampler(Extraction& x, const Effect& effect, uint32_t number,
                            Material& material) {
    for (auto& [s, sampler] : material.samplers)
        if (s == number) return &sampler;
    if (!x.budget.reserve(sizeof(TextureSampler) + kBookBytes, material.where)) return nullptr;
    return &material.samplers.emplace_back(number, effect.samplers[number]).second;
}

// What a material puts in place of a sampler; where the <texture> puts it stays.
void replace_sampler(TextureSampler& own, TextureSampler set, const Effect& effect) {
    if (set.image == kNone && set.surface == own.surface) set.image = own.image;
    for (const TextureSampler& other : effect.samplers)  // a surface that stays
        if (set.image == kNone && !set.surface.empty() && other.surface == set.surface)
            set.image = other.image;
    if (set.image == kNone) set.image = own.image;
    set.repeat = own.repeat;
    set.offset = own.offset;
    set.turn_degrees = own.turn_degrees;
    own = std::move(set);
}

}  // namespace

bool set_sampler(Extraction& x, Link setparam, const Effect& effect, Material& material) {
    const Element* value = setparam.element->first_child;
    while (value && value->name != "surface" && !value->name.starts_with("sampler"))
        value = value->next;
    if (!value) return false;
    bool is_surface = value->name == "surface";
    std::string_view ref = setparam.element->value("ref");
    TextureSampler set;
    set.sid = ref;
    set.where = x.where(setparam);
    set.image = image_of_param(x, setparam, set);
    for (uint32_t s = 0; s < effect.samplers.size(); ++s) {
        if ((is_surface ? effect.samplers[s].surface : effect.samplers[s].sid) != ref) continue;
        TextureSampler* own = own_sampler(x, effect, s, material);
        if (own && is_surface && set.image != kNone) own->image = set.image;
        if (own && !is_surface) replace_sampler(*own, set, effect);
    }
    return true;
}

}  // namespace kinora::collada
