// runtime/programs/convert/axes_p.h: what the parts of --up and --unit share.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "collada/document/edit.h"
#include "runtime/base/math.h"

namespace kinora {

std::string_view trimmed(std::string_view text);

// As COLLADA writes a matrix: by rows.
std::string rows_text(const dmat4& m);

// Text instead of all that stands between the element's tags.
collada::Edit replace_content(const collada::Element& e, const std::string& text,
                              std::string_view original);

// The edits by which skins look as before when `change` moves all nodes. `own` is what the document
// was read with; CONVERT_LOST goes to `diag`.
std::vector<collada::Edit> change_skins(const collada::Document& document, const dmat4& change,
                                        Diagnostics& own, Diagnostics& diag);

}  // namespace kinora
