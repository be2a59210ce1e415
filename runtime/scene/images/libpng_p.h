// runtime/scene/images/libpng_p.h: libpng, opened at the first PNG.
#pragma once

#include <png.h>

#include <csetjmp>

#include "runtime/base/shared_library.h"

namespace kinora {

struct LibPng : SharedLibrary {
    LibPng()
        : SharedLibrary(KINORA_PNG_LIBRARY, "PNG pictures are read and written", "libpng16-16") {}

    KINORA_FUNCTION(png_create_info_struct);
    KINORA_FUNCTION(png_create_read_struct);
    KINORA_FUNCTION(png_create_write_struct);
    KINORA_FUNCTION(png_destroy_read_struct);
    KINORA_FUNCTION(png_destroy_write_struct);
    KINORA_FUNCTION(png_get_error_ptr);
    KINORA_FUNCTION(png_get_image_height);
    KINORA_FUNCTION(png_get_image_width);
    KINORA_FUNCTION(png_get_rowbytes);
    KINORA_FUNCTION(png_get_text);
    KINORA_FUNCTION(png_image_begin_read_from_memory);
    KINORA_FUNCTION(png_image_finish_read);
    KINORA_FUNCTION(png_image_free);
    KINORA_FUNCTION(png_image_write_to_memory);
    KINORA_FUNCTION(png_init_io);
    KINORA_FUNCTION(png_read_end);
    KINORA_FUNCTION(png_read_info);
    KINORA_FUNCTION(png_read_row);
    KINORA_FUNCTION(png_read_update_info);
    KINORA_FUNCTION(png_set_IHDR);
    KINORA_FUNCTION(png_set_compression_level);
    KINORA_FUNCTION(png_set_expand);
    KINORA_FUNCTION(png_set_filler);
    KINORA_FUNCTION(png_set_gray_to_rgb);
    KINORA_FUNCTION(png_set_longjmp_fn);
    KINORA_FUNCTION(png_set_strip_16);
    KINORA_FUNCTION(png_set_text);
    KINORA_FUNCTION(png_write_end);
    KINORA_FUNCTION(png_write_info);
    KINORA_FUNCTION(png_write_row);
};

inline const LibPng& libpng() {
    return opened<LibPng>();
}

// Where libpng jumps to after an error.
inline jmp_buf* png_jump(png_structp png) {
    return libpng().png_set_longjmp_fn(png, longjmp, sizeof(jmp_buf));
}

}  // namespace kinora
