// collada/validate/validate.h: everything that can be said about a document.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "collada/document/document.h"
#include "collada/extract/extract.h"
#include "collada/scene/scene.h"
#include "runtime/base/allowed_paths.h"

namespace kinora::collada {

// What counts as wrong. Default: by the document's own version; what real exporters are known to
// write and every reader tolerates is a warning. Lenient: hints and portability off. Strict: each
// departure from the schema is an error. V1_4_1, V1_5: as Default, by that version's rules.
enum class Profile : uint8_t { Default, Lenient, Strict, V1_4_1, V1_5 };

// Elements of another maker's namespace, the outermost of each, and the schema for them.
struct ForeignElements {
    const Document& document;
    std::string_view name_space;
    const std::string& schema;  // a file that may be read
    std::span<const Element* const> elements;
    const AllowedPaths& files;  // where what the schema includes may lie
    Diagnostics& diag;
};

struct ValidateOptions {
    Profile profile = Profile::Default;
    ExtractOptions extract;
    // Holds elements against their schema, reporting SCHEMA_FOREIGN; "" or why it could not. Empty:
    // such elements are not checked, which is said.
    std::function<std::string(const ForeignElements&)> check_foreign;
};

// Reports, sorted by location and each once: the element table's findings, those of reading every
// element (not only what <scene> reaches), and those of the lint rules of lint.def. The typed scene
// is returned for further checks (profile_RSL); without a visual scene it has no roots.
std::optional<SceneData> validate(const Document& document, Diagnostics& diag,
                                  const ValidateOptions& options = {});

}  // namespace kinora::collada
