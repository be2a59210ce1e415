// collada/lint_ids.cpp: the characters and uniqueness of ids and sids.
#include <unordered_set>

#include "collada/lint_p.h"

namespace kinora::collada {

namespace {

bool is_name_start(unsigned char c) {
    return c == '_' || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c >= 0x80;
}
bool is_name(unsigned char c) {
    return is_name_start(c) || c == '-' || c == '.' || (c >= '0' && c <= '9');
}

// XML Namespaces' NCName; letters beyond ASCII are taken as they come.
bool is_ncname(std::string_view text) {
    if (text.empty() || !is_name_start(static_cast<unsigned char>(text[0]))) return false;
    for (char c : text)
        if (!is_name(static_cast<unsigned char>(c))) return false;
    return true;
}

void check_id(Lint& lint, const Element& element) {
    const Attribute* id = element.attribute("id");
    if (!id) return;
    if (id->value.find_first_of(" \t\r\n<>#%&\"") != std::string_view::npos)
        lint.diag.report(Code::ID_BAD_CHAR, lint.where(element, "id"), id->value);
    else if (!is_ncname(id->value))
        lint.diag.report(Code::ID_NOT_NCNAME, lint.where(element, "id"), id->value);
}

void check_sid(Lint& lint, const Element& element) {
    const Attribute* sid = element.attribute("sid");
    if (sid && sid->value.find_first_of("/(). \t\r\n") != std::string_view::npos)
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
        check_child_sids(lint, *element);
    }
}

}  // namespace kinora::collada
