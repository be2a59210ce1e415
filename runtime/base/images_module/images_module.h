// runtime/base/images_module/images_module.h: the C interface of libkinora_images.so, which alone
// links OpenImageIO (260 shared objects) and is opened when a scene first needs it.
#pragma once

#include <cstdint>

extern "C" {

struct KinoraImage {
    int width, height;
    int channels;       // 1 to 4, the file's first
    int alpha_channel;  // index of alpha among them, or -1
    int is_float;       // pixels are floats, else bytes
    int encoded;        // the file holds integers (16 bits or more come as floats in 0..1)
    int file_channels;  // all that the file has
    int kind;           // 0 an image, 1 an environment, 2 a depth map
    int has_matrices;   // those below; row-major for row vectors
    float world_to_camera[16], world_to_screen[16];
    void* pixels;     // rows from the top, channels interleaved; free with kinora_free_image
    char error[256];  // why it failed
};

// Decodes the first picture of a file, its alpha left unassociated where the file has it so.
// Refuses more than max_pixels. Returns 0, or another number with `error` set and no pixels.
// Thread-safe; throws nothing.
int kinora_decode_image(const char* path, uint64_t max_pixels, KinoraImage* image);
void kinora_free_image(KinoraImage* image);
}
