// runtime/scene/images/libdeflate_p.h: libdeflate, opened at the first EXR that is written; where
// it is missing, OpenEXR compresses by zlib.
#pragma once

#include <libdeflate.h>

#include "runtime/base/shared_library.h"

namespace kinora {

struct LibDeflate : SharedLibrary {
    LibDeflate()
        : SharedLibrary(KINORA_DEFLATE_LIBRARY, "EXR pictures are compressed", "libdeflate0") {}

    KINORA_FUNCTION(libdeflate_alloc_compressor);
    KINORA_FUNCTION(libdeflate_free_compressor);
    KINORA_FUNCTION(libdeflate_zlib_compress);
};

inline const LibDeflate& libdeflate() {
    return opened<LibDeflate>();
}

}  // namespace kinora
