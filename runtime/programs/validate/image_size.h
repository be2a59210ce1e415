// runtime/programs/validate/image_size.h: how large a picture is, from the head of its file,
// without the libraries that decode it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace kinora {

struct ImageSize {
    uint32_t width = 0, height = 0;
    std::string format;  // "png", "jpeg", ...
};

// Nothing when the file cannot be read or is of no format known here: PNG, JPEG, GIF, BMP, TGA,
// DDS, TIFF, EXR, PSD.
std::optional<ImageSize> image_size(const std::string& path);
std::optional<ImageSize> image_size_of_bytes(std::string_view head, std::string_view name);

}  // namespace kinora
