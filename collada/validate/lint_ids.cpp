// collada/validate/lint_ids.cpp: the characters and uniqueness of ids and sids.
#include <algorithm>
#include <array>
#include <unordered_set>

#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

using Letters = std::array<bool, 256>;

constexpr Letters letters(std::string_view list) {
    Letters t{};
    for (char c : list) t[uint8_t(c)] = true;
    return t;
}
constexpr Letters kNotInIds = letters(" \t\r\n<>#%&\""), kNotInSids = letters("/(). \t\r\n");

bool holds_any(std::string_view text, const Letters& list) {
    return std::any_of(text.begin(), text.end(), [&](char c) { return list[uint8_t(c)]; });
}

// That an id is an XML name and unique is for the element table to say.
void check_id(Lint& lint, const Element& element) {
    const Attribute* id = element.attribute("id");
    if (id && holds_any(id->value, kNotInIds))
        lint.diag.report(Code::ID_BAD_CHAR, lint.where(element, "id"), id->value);
}

void check_sid(Lint& lint, const Element& element) {
    const Attribute* sid = element.attribute("sid");
    if (sid && holds_any(sid->value, kNotInSids))
        lint.diag.report(Code::SID_BAD_CHAR, lint.where(element, "sid"), sid->value);
}

void check_child_sids(Lint& lint, const Element& parent) {
    std::unordered_set<std::string_view> seen;
    for (const Element& child : parent.children()) {
        const Attribute* sid = child.attribute("sid");
        if (sid && !seen.insert(sid->value).second)
            lint.diag.report(Code::SID_DUPLICATE, lint.where(child, "sid"), sid->value,
                             parent.name);
    }
}

}  // namespace

void lint_ids(Lint& lint) {
    for (const Element* element : lint.elements) {
        check_id(lint, *element);
        check_sid(lint, *element);
        if (element->first_child) check_child_sids(lint, *element);
    }
}

}  // namespace kinora::collada
