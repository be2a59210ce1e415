// runtime/programs/convert/rsl_files_p.h: names of files in RSL: strings of code and of parameters.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "collada/document/edit.h"

namespace kinora {

struct RslFileName {
    std::string name;          // a relative path
    collada::ByteRange bytes;  // of the name in the document
    bool in_section;           // a CDATA section
};

// String literals of <code>, without those of comments and #include, and <string>s that are no id
// of an <image>. Whether there is such a file the caller finds out.
std::vector<RslFileName> rsl_file_names(const collada::Document& document, std::string_view text);

// Another name in its place.
collada::Edit set_name(const RslFileName& name, const std::string& other);

}  // namespace kinora
