// collada/schema/check_elements.cpp: a document against the table of elements.
#include "collada/schema/check_elements_p.h"
#include "collada/schema/schema.h"

namespace kinora::collada {

ElementChecker::ElementChecker(const Document& document, Diagnostics& diag, Version version)
    : document_(document),
      diag_(diag),
      types_(ElementTypes::of(version)),
      namespaces_(document.root(), diag.files.text(document.file())) {}

const ElementTypes& ElementChecker::other_version() const {
    return ElementTypes::of(is_15(types_.version()) ? Version::V1_4_1 : Version::V1_5_0);
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

void ElementChecker::report_foreign(const Element& child) {
    std::string_view uri = namespaces_.of(child);
    if (!first(Code::SCHEMA_FOREIGN, nullptr, uri)) return;
    if (!namespaces_.schema(child, uri).empty()) return;  // lint_foreign speaks of these
    diag_.report(Code::SCHEMA_FOREIGN, document_.location(child), uri, "");
}

void check_elements(const Document& document, Diagnostics& diag, Version version) {
    ElementChecker(document, diag, version).run();
}

void check_elements(const Document& document, Diagnostics& diag) {
    check_elements(document, diag, document.version());
}

}  // namespace kinora::collada
