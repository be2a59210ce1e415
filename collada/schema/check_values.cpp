// collada/schema/check_values.cpp: attributes and texts against the element table.
#include "collada/schema/check_elements_p.h"
#include "collada/text/numbers_p.h"
#include "collada/text/words_p.h"

namespace kinora::collada {

namespace {

bool is_declaration(std::string_view name) {
    return name == "xmlns" || name.starts_with("xmlns:") || name.starts_with("xsi:");
}

std::string range_text(const SimpleType& type) {
    if (!type.has_high) return fmt::format("{} on", type.low);
    return fmt::format("{} to {}", type.low, type.high);
}

}  // namespace

std::string shortened(std::string_view value) {
    constexpr size_t kMost = 40;
    std::string out(trim(value).substr(0, kMost));
    while (!out.empty() && (out.back() & 0x80)) out.pop_back();  // not half a character
    for (char& c : out)
        if (c == '\n' || c == '\r' || c == '\t') c = ' ';
    return trim(value).size() > kMost ? out + "..." : std::string(trim(value));
}

void ElementChecker::check_attributes(const Element& element, const ElementType& type) {
    const ElementRules& rules = type.rules();
    uint64_t present = 0;
    for (const Attribute& a : element.attributes) {
        size_t i = 0;
        while (i < rules.attributes.size() && rules.attributes[i].name != a.name) ++i;
        if (i == rules.attributes.size()) {
            unknown_attribute(element, type, a);
            continue;
        }
        present |= uint64_t(1) << i;
        check_attribute(element, type, a, rules.attributes[i]);
    }
    for (size_t i = 0; i < rules.attributes.size(); ++i) {
        const AttributeType& rule = rules.attributes[i];
        if (!rule.required || (present >> i & 1)) continue;
        if (first(Code::SCHEMA_MISSING_ATTRIBUTE, &type, rule.name))
            diag_.report(Code::SCHEMA_MISSING_ATTRIBUTE, document_.location(element), element.name,
                         rule.name);
    }
}

void ElementChecker::unknown_attribute(const Element& element, const ElementType& type,
                                       const Attribute& a) {
    if (is_declaration(a.name)) return;
    if (type.rules().foreign_xml && a.name.starts_with("xml:")) return;
    if (!first(Code::SCHEMA_UNKNOWN_ATTRIBUTE, &type, a.name)) return;
    Finding& finding =
        diag_.report(Code::SCHEMA_UNKNOWN_ATTRIBUTE,
                     Location{document_.file(), a.bytes.begin, a.bytes.end}, element.name, a.name);
    if (!may_suggest()) return;
    std::vector<std::string_view> names;
    for (const AttributeType& rule : type.rules().attributes) names.push_back(rule.name);
    std::string_view near = nearest_name(a.name, names);
    if (!near.empty()) finding.help = fmt::format("did you mean '{}'?", near);
}

// Only attributes that the table calls an ID count: <extra> may hold what it likes.
void ElementChecker::check_id(const Element& element, const Attribute& id) {
    Location where{document_.file(), id.value_bytes.begin, id.value_bytes.end};
    if (!is_ncname(trim(id.value))) diag_.report(Code::ID_NOT_NCNAME, where, id.value);
    const Element* first_one = document_.find(id.value);
    if (!first_one || (first_one == &element && !element.next_same_id)) return;
    auto [at, fresh] = shared_ids_.emplace(id.value, &element);
    if (fresh) return;
    Finding& finding = diag_.report(Code::ID_DUPLICATE, where, id.value);
    finding.notes.push_back({document_.location(*at->second, "id"), "also used here"});
}

void ElementChecker::check_attribute(const Element& element, const ElementType& type,
                                     const Attribute& a, const AttributeType& rule) {
    if (!element.parent && a.name == "version") return;  // DOC_VERSION speaks of it
    if (rule.type.base->name == "ID") return check_id(element, a);
    ValueCheck check = check_value(rule.type, a.value);
    if (check.fault == ValueFault::None) return;
    Location where{document_.file(), a.value_bytes.begin, a.value_bytes.end};
    report_value(element, type, &a, rule.type, check, a.value, where);
}

void ElementChecker::check_text(const Element& element, const ElementType& type) {
    const ElementRules& rules = type.rules();
    if (!rules.has_text) {
        bool space = trim(element.text).empty();
        if (element.text.empty() || (space && !rules.content.empty())) return;
        if (!first(Code::SCHEMA_TEXT, &type, {})) return;
        Finding& finding =
            diag_.report(Code::SCHEMA_TEXT,
                         space ? document_.location(element) : document_.text_location(element),
                         element.name, space ? "white space" : shortened(element.text),
                         rules.content.empty() ? "nothing" : "only elements");
        if (space && finding.severity > Severity::Hint) finding.severity = Severity::Hint;
        return;
    }
    if (rules.has_default && element.text.empty()) return;
    ValueCheck check = check_value(rules.text, element.text);
    if (check.fault == ValueFault::None) return;
    Location where = check.end > check.begin && !element.text_map.empty()
                         ? document_.text_location(element, check.begin, check.end)
                         : document_.location(element);
    if (check.fault == ValueFault::Length) where = document_.location(element);
    report_value(element, type, nullptr, rules.text, check,
                 element.text.substr(check.begin, check.end - check.begin), where);
}

void ElementChecker::report_value(const Element& element, const ElementType& type,
                                  const Attribute* a, const SimpleType& simple,
                                  const ValueCheck& check, std::string_view value, Location where) {
    std::string_view key = a ? a->name : std::string_view();
    auto once = [&](const FindingInfo& code) { return first(code, &type, key); };
    std::string shown = shortened(value);
    switch (check.fault) {
        case ValueFault::None:
            return;
        case ValueFault::Type:
            if (a && once(Code::SCHEMA_ATTR_VALUE))
                diag_.report(Code::SCHEMA_ATTR_VALUE, where, a->name, element.name, shown,
                             describe(simple));
            if (!a && once(Code::SCHEMA_TEXT))
                diag_.report(Code::SCHEMA_TEXT, where, element.name, shown, describe(simple));
            return;
        case ValueFault::Value:
            if (once(Code::SCHEMA_ENUM))
                diag_.report(Code::SCHEMA_ENUM, where, shown, element.name).help =
                    "expected " + describe(simple);
            return;
        case ValueFault::Range:
            if (once(Code::SCHEMA_RANGE))
                diag_.report(Code::SCHEMA_RANGE, where, shown, element.name, range_text(simple));
            return;
        case ValueFault::Length:
            if (once(Code::SCHEMA_LENGTH))
                diag_.report(Code::SCHEMA_LENGTH, where, element.name, check.words, simple.length);
            return;
        case ValueFault::Pattern:
            if (once(Code::SCHEMA_PATTERN))
                diag_.report(Code::SCHEMA_PATTERN, where, shown, element.name, describe(simple));
            return;
    }
}

}  // namespace kinora::collada
