// collada/text/byte_range.h: a piece of a file.
#pragma once

#include <cstdint>

namespace kinora::collada {

// All offsets are bytes of the text registered in Diagnostics.files. For a file that is not UTF-8
// that text is its UTF-8 transcript; a BOM is left out of it.
struct ByteRange {
    uint32_t begin = 0;
    uint32_t end = 0;
};

}  // namespace kinora::collada
