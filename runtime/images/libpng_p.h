// runtime/images/libpng_p.h: libpng, opened at the first PNG.
#pragma once

#include <png.h>

#include <csetjmp>

#include "runtime/base/shared_library.h"

namespace kinora {

#define KINORA_PNG_FUNCTIONS(X)                                                              \
    X(png_create_info_struct)                                                                \
    X(png_create_read_struct) X(png_create_write_struct) X(png_destroy_read_struct)          \
        X(png_destroy_write_struct) X(png_get_error_ptr) X(png_get_image_height)             \
            X(png_get_image_width) X(png_get_text) X(png_image_begin_read_from_memory)       \
                X(png_image_finish_read) X(png_image_free) X(png_image_write_to_memory)      \
                    X(png_init_io) X(png_read_end) X(png_read_info) X(png_read_row)          \
                        X(png_read_update_info) X(png_set_IHDR) X(png_set_compression_level) \
                            X(png_set_expand) X(png_set_filler) X(png_set_gray_to_rgb)       \
                                X(png_set_longjmp_fn) X(png_set_strip_16) X(png_set_text)    \
                                    X(png_write_end) X(png_write_info) X(png_write_row)

struct LibPng {
    KINORA_PNG_FUNCTIONS(KINORA_LIBRARY_MEMBER)
    std::string error;  // why there are none, or ""

    LibPng() {
        SharedLibrary library(KINORA_PNG_LIBRARY, "PNG pictures are read and written",
                              "libpng16-16");
        KINORA_PNG_FUNCTIONS(KINORA_LIBRARY_BIND)
        error = library.error();
    }
};

inline const LibPng& libpng() {
    static const LibPng functions;
    return functions;
}

// Where libpng jumps to after an error.
inline jmp_buf* png_jump(png_structp png) {
    return libpng().png_set_longjmp_fn(png, longjmp, sizeof(jmp_buf));
}

}  // namespace kinora
