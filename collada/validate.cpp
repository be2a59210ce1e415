// collada/validate.cpp: the element table, the reader and the lint rules over one document.
#include "collada/validate.h"

#include "collada/lint_p.h"

namespace kinora::collada {

namespace {

void list_elements(const Element& element, std::vector<const Element*>& list) {
    list.push_back(&element);
    for (const Element& child : element.children()) list_elements(child, list);
}

constexpr void (*kRules[])(Lint&) = {
#define LINT(name, about) lint_##name,
#include "collada/lint.def"
#undef LINT
};

}  // namespace

std::optional<SceneData> validate(const Document& document, Diagnostics& diag,
                                  const ValidateOptions& options) {
    ExtractOptions everything = options.extract;
    everything.everything = true;
    std::optional<SceneData> scene = extract(document, diag, everything);
    Lint lint{document, scene ? &*scene : nullptr, options, diag, {}};
    lint.elements.reserve(document.element_count());
    list_elements(document.root(), lint.elements);
    for (auto rule : kRules) rule(lint);
    diag.sort_unique();
    return scene;
}

}  // namespace kinora::collada
