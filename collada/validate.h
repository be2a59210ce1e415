// collada/validate.h: everything that can be said about a document.
#pragma once

#include "collada/document.h"
#include "collada/scene.h"

namespace kinora::collada {

// What counts as wrong. Default: by the document's own version; what real exporters are known to
// write and every reader tolerates is a warning. Lenient: hints and portability off. Strict: each
// departure from the schema is an error. V1_4_1, V1_5: as Default, by that version's rules.
enum class Profile : uint8_t { Default, Lenient, Strict, V1_4_1, V1_5 };

struct ValidateOptions {
    Profile profile = Profile::Default;
    ExtractOptions extract;
};

// Reports, sorted by place and each once: the element table's findings, those of reading every
// element (not only what <scene> reaches), and those of the lint rules of lint.def. The typed scene
// is returned for further checks (profile_RSL); without a visual scene it has no roots.
std::optional<SceneData> validate(const Document& document, Diagnostics& diag,
                                  const ValidateOptions& options = {});

}  // namespace kinora::collada
