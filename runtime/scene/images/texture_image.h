// runtime/scene/images/texture_image.h: an image file's pixels, as they were encoded.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace kinora {

// What a file says of itself. Matrices are row-major for row vectors, as RenderMan writes them.
struct TextureFacts {
    int width = 0, height = 0;
    int channels = 0;              // of the file
    const char* type = "texture";  // or "environment", "shadow"
    bool has_matrices = false;
    std::array<float, 16> world_to_camera{}, world_to_screen{};
};

// RGBA rows from the top, unassociated as in the file; either bytes or floats. Grey is expanded to
// r = g = b; alpha is 1 where the file has none.
struct TextureImage {
    int width = 0, height = 0;
    int colors = 3;          // colour channels that mean something, 1 to 3
    bool by_module = false;  // OpenImageIO decoded it
    bool encoded = false;    // integers in the file: sRGB, unless they are data
    std::vector<uint8_t> bytes;
    std::vector<float> floats;  // integers of 16 bits are 0..1
    TextureFacts facts;

    bool is_float() const { return !floats.empty(); }
};

// Larger images are refused (16384 x 8192 is the last to pass): a pyramid of bytes takes 10.7 bytes
// a pixel, one of floats twice as much.
inline constexpr uint64_t kMaxTexturePixels = uint64_t(1) << 27;
inline constexpr uint64_t kMaxTextureSide = 65536;

// Decodes a file, or a MemoryFile: plain PNG by libpng, all else by the OpenImageIO module, which
// is opened when it is first needed. Returns "" or why it failed. Thread-safe.
std::string read_texture_image(const std::string& name, TextureImage& image);

// The part of the image that begins `from` rows below its top.
TextureImage image_rows(const TextureImage& image, int from, int rows);

// 8x8 checks of magenta and black, what is seen in place of an unreadable image.
TextureImage checks_image();

}  // namespace kinora
