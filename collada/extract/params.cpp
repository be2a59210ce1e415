// collada/extract/params.cpp: typed values of <newparam>, <setparam> and <bind>.
#include <cmath>

#include "collada/document/element_numbers_p.h"
#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"

namespace kinora::collada {

namespace {

// Words of a <bool> become numbers; other texts are read as they are.
std::vector<double> read_numbers(Extraction& x, Link link, ParamType type) {
    if (type != ParamType::Bool) return read_doubles(x.document(link.doc), *link.element, x.diag);
    std::vector<double> numbers;
    for (std::string_view word : split_words(link.element->text))
        numbers.push_back(parse_bool(word).value_or(false));
    return numbers;
}

// docs/format.md#profile_rsl: one value is grey, three are as they are, the fourth is dropped.
void fit_color(Extraction& x, Link link, std::vector<double>& numbers) {
    if (numbers.size() == 1) numbers.resize(3, numbers[0]);
    if (numbers.size() != 4) return;
    x.diag.report(Code::FX_COLOR_ALPHA, x.text_where(link));
    numbers.pop_back();
}

void read_string(Extraction& x, Link link, ParamValue& out) {
    out.strings.emplace_back(trim(link.element->text));
    std::string_view id = out.strings.back();  // of an image, perhaps with words behind a '?'
    const Element* image = find_kind(x.document(link.doc), id, {"image"});
    if (!image && id.find('?') != std::string_view::npos)
        image = find_kind(x.document(link.doc), id.substr(0, id.find('?')), {"image"});
    if (image) out.image = image_index(x, {link.doc, image});
}

bool read_simple(Extraction& x, Link link, ParamValue& out) {
    if (out.type == ParamType::String) {
        read_string(x, link, out);
        return true;
    }
    std::vector<double> numbers = read_numbers(x, link, out.type);
    if (out.type == ParamType::Color) fit_color(x, link, numbers);
    for (double& n : numbers)
        if (!std::isfinite(n)) n = 0;
    uint32_t components = component_count(out.type);
    if (numbers.empty() || numbers.size() % components) {
        x.diag.report(Code::SCHEMA_LENGTH, x.where(link), link.element->name, numbers.size(),
                      components);
        if (numbers.empty()) return false;
        numbers.resize((numbers.size() / components + 1) * components, 0.0);
    }
    out.numbers.insert(out.numbers.end(), numbers.begin(), numbers.end());
    return true;
}

// <array length="n"> holds values of one type.
bool read_array(Extraction& x, Link link, ParamValue& out) {
    bool first = true;
    for (const Element& child : link.element->children()) {
        ParamType type;
        if (!find_param_type(child.name, type) || (!first && type != out.type)) continue;
        out.type = type;
        first = false;
        if (!read_simple(x, {link.doc, &child}, out)) return false;
    }
    out.array_length = out.type == ParamType::String
                           ? uint32_t(out.strings.size())
                           : uint32_t(out.numbers.size() / component_count(out.type));
    return out.array_length > 0;
}

}  // namespace

const Element* value_child(const Element& owner) {
    ParamType type;
    for (const Element& child : owner.children())
        if (child.name == "array" || find_param_type(child.name, type)) return &child;
    return nullptr;
}

bool read_param_value(Extraction& x, Link link, ParamValue& out) {
    out.where = x.where(link);
    if (link.element->name == "array") return read_array(x, link, out);
    if (!find_param_type(link.element->name, out.type)) {
        x.diag.report(Code::FX_VALUE, out.where, link.element->name);
        return false;
    }
    if (!read_simple(x, link, out)) return false;
    size_t entries = out.numbers.size() / component_count(out.type);
    if (entries > 1) out.array_length = uint32_t(entries);
    return true;
}

uint32_t find_param(Extraction& x, const Effect& effect, std::string_view sid) {
    constexpr size_t kFew = 16;
    if (effect.params.size() <= kFew) {
        for (size_t i = effect.params.size(); i-- > 0;)  // inner scopes are read last
            if (effect.params[i].sid == sid) return uint32_t(i);
        return kNone;
    }
    uint64_t location = uint64_t(effect.where.file) << 32 | effect.where.begin;
    NameIndex& index = x.params_of_effect[location];
    for (; index.known < effect.params.size(); ++index.known)
        index.at.insert_or_assign(effect.params[index.known].sid, uint32_t(index.known));
    auto found = index.at.find(std::string(sid));
    return found == index.at.end() ? kNone : found->second;
}

void read_params(Extraction& x, Link owner, ParamScope scope, uint32_t effect_number,
                 Effect& effect) {
    for (const Element& child : owner.element->children()) {
        if (child.name != "newparam") continue;
        // Samplers and surfaces are read where a <texture> names them.
        const Element* value = value_child(child);
        if (!value) continue;
        Param param;
        param.sid = child.value("sid");
        if (const Element* semantic = child.child("semantic"))
            param.semantic = trim(semantic->text);
        param.scope = scope;
        param.where = x.where({owner.doc, &child});
        if (!read_param_value(x, {owner.doc, value}, param.value)) continue;
        TargetRef ref{Owner::EffectParam, effect_number, uint32_t(effect.params.size()), 0,
                      uint32_t(param.value.numbers.size())};
        x.target_of[&child] = x.target_of[value] = ref;
        effect.params.push_back(std::move(param));
    }
}

}  // namespace kinora::collada
