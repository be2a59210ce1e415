// collada/validate/fix.h: repairs of what validation finds, as edits of the document's bytes.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "collada/validate/validate.h"

namespace kinora::collada {

// How often one kind of finding was repaired.
struct FixCount {
    const FindingInfo* info = nullptr;
    size_t count = 0;
};

struct FixResult {
    std::string text;
    std::vector<FixCount> fixes;  // empty: the text is as it was
    // Where the bytes were no UTF-8 and something was repaired: what they say in UTF-8. `text` is
    // UTF-8 then and declares it.
    std::string recoded;
};

// Repairs `text` until nothing more can be done: order of children, empty libraries, paths, counts,
// decimal commas, links without '#', single '&', up axes. Every byte no repair needs stays. `path`
// is that of the document: paths in it are made relative to its folder. `wanted` says whether a
// code is to be repaired. A text that is no whole XML is left alone. Repairing the result again
// changes nothing.
FixResult fix_text(const std::string& path, std::string text, const ValidateOptions& options,
                   bool (*wanted)(const FindingInfo&, const void*), const void* context);

// The codes that fix_text knows, in the order in which it takes them.
std::vector<const FindingInfo*> fixable_findings();

}  // namespace kinora::collada
