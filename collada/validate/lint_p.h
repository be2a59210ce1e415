// collada/validate/lint_p.h: rules only the validator runs. A rule looks at the whole document,
// reached by <scene> or not, and reports what reading it (extract) cannot see or does not care
// about. What extract reports, a rule does not report again (an exact repeat is dropped by
// validate).
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "collada/document/findings.h"
#include "collada/extract/extract_p.h"
#include "collada/validate/validate.h"

namespace kinora::collada {

struct Lint {
    Extraction& x;  // as extract left it: the scene, linked documents, what became of elements
    const Document& document;
    const SceneData& scene;  // everything of the document that could be read
    const ValidateOptions& options;
    Diagnostics& diag;
    std::vector<const Element*> elements;  // in document order
    std::unordered_map<std::string_view, std::vector<const Element*>> by_name;

    // The elements of this name, in document order; not those inside a <technique profile> of other
    // makers, where names mean what their maker says (RSL's are ours).
    std::span<const Element* const> named(std::string_view name) const {
        auto found = by_name.find(name);
        if (found == by_name.end()) return {};
        return found->second;
    }
    Location where(const Element& element) const { return document.location(element); }
    Location where(const Element& element, std::string_view attribute) const {
        return document.location(element, attribute);
    }
};

// One function a row of lint.def, in a file named after it: lint_NAME.cpp.
#define LINT(name, about) void lint_##name(Lint& lint);
#include "collada/validate/lint.def"
#undef LINT

}  // namespace kinora::collada
