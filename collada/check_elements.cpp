// collada/check_elements.cpp: a document against the table of elements.
#include "collada/check_elements_p.h"
#include "collada/schema.h"

namespace kinora::collada {

namespace {

Version other(Version version) {
    return is_15(version) ? Version::V1_4_1 : Version::V1_5_0;
}

// Of xsi:schemaLocation="namespace file namespace file": the file of a namespace, or "".
std::string_view schema_location(const Element& root, std::string_view name_space) {
    for (const Attribute& a : root.attributes) {
        if (!a.name.ends_with(":schemaLocation")) continue;
        size_t at = a.value.find(name_space);
        if (at == a.value.npos) continue;
        std::string_view rest = a.value.substr(at + name_space.size());
        size_t begin = rest.find_first_not_of(" \t\r\n");
        if (begin == 0 || begin == rest.npos) continue;
        return rest.substr(begin, rest.find_first_of(" \t\r\n", begin) - begin);
    }
    return {};
}

}  // namespace

ElementChecker::ElementChecker(const Document& document, Diagnostics& diag, Version version)
    : document_(document),
      diag_(diag),
      types_(ElementTypes::of(version)),
      other_version_(ElementTypes::of(other(version))) {
    const Element& root = document.root();
    for (const Attribute& a : root.attributes) {
        bool declares = a.name == "xmlns" || a.name.starts_with("xmlns:");
        if (!declares || a.value.find("collada.org") == a.value.npos) continue;
        xmlns_ = a.name;
        name_space_ = a.value;
    }
    if (xmlns_.empty()) name_space_ = root.value("xmlns");
}

void ElementChecker::run() {
    const Element& root = document_.root();
    if (document_.version() == Version::V1_4_0)
        diag_.report(Code::DOC_OLD_VERSION, document_.location(root, "version"));
    check(root, types_.root(), false);
}

void ElementChecker::check(const Element& element, const ElementType& type, bool kept) {
    if (type.rules().anything) {
        for (const Element& child : element.children()) check_any(child, true);
        return;
    }
    if (!kept) report_unsupported(element, type);
    check_attributes(element, type);
    check_text(element, type);
    check_children(element, type, kept || (type.row && type.use != Use::Rendered));
}

void ElementChecker::report_unsupported(const Element& element, const ElementType& type) {
    if (type.use == Use::Unsupported && first(Code::INFO_UNSUPPORTED, &type, element.name))
        diag_.report(Code::INFO_UNSUPPORTED, document_.location(element), element.name);
}

// Where anything may stand, XML Schema checks the elements it knows by name.
void ElementChecker::check_any(const Element& child, bool kept) {
    if (foreign(child)) return report_foreign(child);
    if (const ElementType* type = types_.global(child.name)) return check(child, *type, kept);
    for (const Element& inner : child.children()) check_any(inner, kept);
}

std::string_view ElementChecker::name_space(const Element& child) const {
    size_t colon = child.name.find(':');
    std::string wanted = "xmlns";
    if (colon != child.name.npos) wanted += ":" + std::string(child.name.substr(0, colon));
    for (const Element* e = &child; e; e = e->parent)
        if (const Attribute* a = e->attribute(wanted)) return a->value;
    return {};
}

bool ElementChecker::foreign(const Element& child) const {
    if (child.name.find(':') != child.name.npos) return name_space(child) != name_space_;
    for (const Attribute& a : child.attributes)
        if (a.name == xmlns_) return a.value != name_space_;
    return false;
}

void ElementChecker::report_foreign(const Element& child) {
    std::string_view uri = name_space(child);
    if (!first(Code::SCHEMA_FOREIGN, nullptr, uri)) return;
    std::string_view file = schema_location(document_.root(), uri);
    diag_.report(
        Code::SCHEMA_FOREIGN, document_.location(child), uri,
        file.empty() ? std::string() : ": their schema '" + std::string(file) + "' is not read");
}

void check_elements(const Document& document, Diagnostics& diag, Version version) {
    ElementChecker(document, diag, version).run();
}

void check_elements(const Document& document, Diagnostics& diag) {
    check_elements(document, diag, document.version());
}

}  // namespace kinora::collada
