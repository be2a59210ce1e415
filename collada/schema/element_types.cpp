// collada/schema/element_types.cpp: rows of the element table become rules.
#include "collada/schema/element_types_p.h"

#include <algorithm>

#include "collada/text/numbers_p.h"
#include "runtime/base/check.h"

namespace kinora::collada {

namespace {

// "!name:type=default" or "!name:type='a default'", from `at` on; moves `at` behind it.
AttributeType parse_attribute(std::string_view cell, size_t& at, Version version) {
    AttributeType out;
    if (cell[at] == '!') out.required = true, ++at;
    size_t end = std::min(cell.find_first_of(" =", at), cell.size());
    std::string_view word = cell.substr(at, end - at);
    size_t colon = word.rfind(':');  // xml:base:anyURI
    out.name = word.substr(0, colon);
    out.type = parse_simple(word.substr(colon + 1), version);
    at = end;
    if (at < cell.size() && cell[at] == '=') {
        bool quoted = cell[++at] == '\'';
        at += quoted;
        end = std::min(cell.find(quoted ? '\'' : ' ', at), cell.size());
        out.has_default = true;
        out.default_value = cell.substr(at, end - at);
        at = end + quoted;
    }
    at = std::min(cell.find_first_not_of(' ', at), cell.size());
    return out;
}

void parse_text(std::string_view cell, ElementRules& rules, Version version) {
    rules.anything = cell == "%anything";
    if (cell.empty() || rules.anything) return;
    size_t equals = cell.find(" = ");
    rules.has_text = true;
    rules.text = parse_simple(cell.substr(0, equals), version);
    if (equals == cell.npos) return;
    rules.has_default = true;
    rules.default_text = cell.substr(equals + 3);
}

void collect_names(const Particle& particle, std::vector<std::string_view>& names) {
    if (particle.kind == Particle::Kind::Element) names.push_back(particle.name);
    for (const Particle& part : particle.parts) collect_names(part, names);
}

}  // namespace

const ElementRules& ElementType::rules() const {
    std::call_once(once_,
                   [&] { rules_ = std::make_unique<const ElementRules>(types_->parse(*this)); });
    return *rules_;
}

const ElementTypes& ElementTypes::of(Version version) {
    if (is_15(version)) {
        static const ElementTypes kTypes15(Version::V1_5_0);
        return kTypes15;
    }
    static const ElementTypes kTypes14(Version::V1_4_1);
    return kTypes14;
}

ElementTypes::ElementTypes(Version version) : version_(version) {
    for (const ElementRow& row : element_rows()) {
        if (!holds_for(row.versions, version)) continue;
        ElementType& type = rows_.emplace_back();
        type.name = row.type;
        type.row = &row;
        type.use = row.use;
        type.types_ = this;
        by_name_.emplace(type.name, &type);
    }
    for (const ContentRow& row : global_rows()) {
        if (!holds_for(row.versions, version)) continue;
        for (const Particle& part : parse_content(row.content).parts)
            globals_.emplace(part.name, find(part.type));
    }
}

const ElementType* ElementTypes::find(std::string_view type) const {
    if (!type.starts_with('=')) {
        auto found = by_name_.find(type);
        return found == by_name_.end() ? nullptr : found->second;
    }
    std::lock_guard lock(mutex_);
    const ElementType*& known = texts_by_name_[type];
    if (!known) {
        ElementType& made = texts_.emplace_back();
        made.name = type;
        made.types_ = this;
        known = &made;
    }
    return known;
}

ElementRules ElementTypes::parse(const ElementType& type) const {
    ElementRules rules;
    if (!type.row) {
        parse_text(type.name.substr(1), rules, version_);
        rules.content = build_model("", version_);
        return rules;
    }
    std::string_view attributes = type.row->attributes;
    for (size_t at = 0; at < attributes.size();) {
        rules.attributes.push_back(parse_attribute(attributes, at, version_));
        if (rules.attributes.back().name.starts_with("xml:")) rules.foreign_xml = true;
    }
    rules.content = build_model(type.row->content, version_);
    for (ContentModel::Position& position : rules.content.positions) {
        if (position.type_name.empty()) continue;
        position.type = find(position.type_name);
        CHECK(position.type);  // a row that names a type without one
    }
    parse_text(type.row->text, rules, version_);
    return rules;
}

const ElementType* ElementTypes::global(std::string_view element) const {
    auto found = globals_.find(element);
    return found == globals_.end() ? nullptr : found->second;
}

const ElementType* ElementTypes::of_element(const Element& element) const {
    if (!element.parent) return &root();
    const ElementType* parent = of_element(*element.parent);  // as deep as a document may be
    if (!parent) return global(element.name);
    const ContentModel& content = parent->rules().content;
    if (uint16_t position = content.find(element.name)) return content.positions[position].type;
    return global(element.name);
}

const std::vector<std::string_view>& ElementTypes::element_names() const {
    std::call_once(names_once_, [&] {
        names_.push_back("COLLADA");
        for (const ElementType& type : rows_)
            collect_names(parse_content(type.row->content), names_);
        for (const ContentRow& row : group_rows())
            if (holds_for(row.versions, version_))
                collect_names(parse_content(row.content), names_);
        std::sort(names_.begin(), names_.end());
        names_.erase(std::unique(names_.begin(), names_.end()), names_.end());
    });
    return names_;
}

bool ElementTypes::has_element(std::string_view name) const {
    const auto& names = element_names();
    return std::binary_search(names.begin(), names.end(), name);
}

std::string_view ElementTypes::nearest(std::string_view name) const {
    return nearest_name(name, element_names());
}

}  // namespace kinora::collada
