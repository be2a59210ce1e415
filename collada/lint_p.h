// collada/lint_p.h: rules only the validator runs. A rule looks at the whole document, reached by
// <scene> or not, and reports what reading it (extract) cannot see or does not care about. What
// extract reports, a rule does not report again.
#pragma once

#include <vector>

#include "collada/findings.h"
#include "collada/validate.h"

namespace kinora::collada {

struct Lint {
    const Document& document;
    const SceneData* scene;  // null: nothing to show
    const ValidateOptions& options;
    Diagnostics& diag;
    std::vector<const Element*> elements;  // in document order

    Location where(const Element& element) const { return document.location(element); }
    Location where(const Element& element, std::string_view attribute) const {
        return document.location(element, attribute);
    }
};

// One function a row of lint.def, in a file named after it: lint_NAME.cpp.
#define LINT(name, about) void lint_##name(Lint& lint);
#include "collada/lint.def"
#undef LINT

}  // namespace kinora::collada
