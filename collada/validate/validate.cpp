// collada/validate/validate.cpp: the element table, the reader and the lint rules over one
// document.
#include "collada/validate/validate.h"

#include "collada/extract/extract.h"
#include "collada/validate/lint_p.h"

namespace kinora::collada {

namespace {

bool is_foreign(const Element& element) {
    if (element.name != "technique") return false;
    const Attribute* profile = element.attribute("profile");
    return profile && profile->value != "RSL" && profile->value != "COMMON";
}

// As deep as the document may be.
void list_elements(const Element& element, bool ours, Lint& lint) {
    lint.elements.push_back(&element);
    if (ours) lint.by_name[element.name].push_back(&element);
    ours = ours && !is_foreign(element);
    for (const Element& child : element.children()) list_elements(child, ours, lint);
}

constexpr void (*kRules[])(Lint&) = {
#define LINT(name, about) lint_##name,
#include "collada/validate/lint.def"
#undef LINT
};

}  // namespace

std::optional<SceneData> validate(const Document& document, Diagnostics& diag,
                                  const ValidateOptions& options) {
    ExtractOptions everything = options.extract;
    everything.everything = true;
    Extraction x(diag, everything);
    if (options.profile == Profile::V1_4_1) x.documents.hold_to(Version::V1_4_1);
    if (options.profile == Profile::V1_5) x.documents.hold_to(Version::V1_5_0);
    bool shown = extract_into(x, document);
    Lint lint{x, document, x.scene, options, diag, {}, {}};
    lint.elements.reserve(document.element_count());
    list_elements(document.root(), true, lint);
    for (auto rule : kRules) rule(lint);
    diag.sort_unique();
    if (!shown) return std::nullopt;
    return std::move(x.scene);
}

}  // namespace kinora::collada
