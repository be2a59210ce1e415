// collada/validate/fix_p.h: a repairer gets the findings of one code and gives edits that remove
// them.
#pragma once

#include <vector>

#include "collada/document/edit.h"
#include "collada/document/findings.h"
#include "collada/document/id_path.h"
#include "collada/scene/scene.h"

namespace kinora::collada {

struct FixContext {
    const Document& document;
    std::string_view text;   // the document's
    const SceneData* scene;  // what reading gave, or null
    const ElementIndex& elements;
    std::vector<const Finding*> findings;  // of the repairer's code, in this document
    std::vector<Edit> edits;               // to be filled
};

// fix_order.cpp: whole documents, since a habit of a file is reported once.
void fix_order(FixContext& context);
void fix_empty_libraries(FixContext& context);
// fix_counts.cpp
void fix_array_count(FixContext& context);
void fix_accessor_stride(FixContext& context);
void fix_accessor_count(FixContext& context);
void fix_primitive_count(FixContext& context);
// fix_text.cpp
void fix_comma_decimals(FixContext& context);
void fix_missing_hash(FixContext& context);
void fix_path(FixContext& context);
void fix_up_axis(FixContext& context);

}  // namespace kinora::collada
