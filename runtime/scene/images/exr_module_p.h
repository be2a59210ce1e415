// runtime/scene/images/exr_module_p.h: the functions of libkinora_exr.so, opened at the first EXR.
#pragma once

#include "runtime/base/exr_module/exr_module.h"
#include "runtime/base/shared_library.h"

namespace kinora {

struct ExrModule : SharedLibrary {
    ExrModule()
        : SharedLibrary(module_path("libkinora_exr.so"), "EXR pictures are read and written",
                        "libopenexr-3-1-30") {}

    KINORA_FUNCTION(kinora_exr_begin);
    KINORA_FUNCTION(kinora_exr_write);
    KINORA_FUNCTION(kinora_exr_end);
    KINORA_FUNCTION(kinora_exr_text);
    KINORA_FUNCTION(kinora_exr_see);
    KINORA_FUNCTION(kinora_exr_read);
    KINORA_FUNCTION(kinora_exr_free_pixels);
};

inline const ExrModule& exr_module() {
    return opened<ExrModule>();
}

}  // namespace kinora
