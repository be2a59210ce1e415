// runtime/images/exr_module_p.h: the functions of libkinora_exr.so, opened at the first EXR.
#pragma once

#include "runtime/base/shared_library.h"
#include "runtime/exr_module/exr_module.h"

namespace kinora {

#define KINORA_EXR_FUNCTIONS(X)                                                 \
    X(kinora_exr_begin)                                                         \
    X(kinora_exr_write) X(kinora_exr_end) X(kinora_exr_text) X(kinora_exr_read) \
        X(kinora_exr_free_pixels)

struct ExrModule {
    KINORA_EXR_FUNCTIONS(KINORA_LIBRARY_MEMBER)
    std::string error;  // why there are none, or ""

    ExrModule() {
        SharedLibrary library(module_path("libkinora_exr.so"), "EXR pictures are read and written",
                              "libopenexr-3-1-30");
        KINORA_EXR_FUNCTIONS(KINORA_LIBRARY_BIND)
        error = library.error();
    }
};

inline const ExrModule& exr_module() {
    static const ExrModule module;
    return module;
}

}  // namespace kinora
