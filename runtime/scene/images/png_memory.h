// runtime/scene/images/png_memory.h: pictures as bytes and texts of other files.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/scene/images/image_io.h"

namespace kinora {

std::vector<uint8_t> encode_png(const Image8& image);
// Nothing where these are no PNG, or one of more than 2^28 pixels.
std::optional<Image8> decode_png(std::span<const uint8_t> bytes);

// RFC 4648, section 4.
std::string base64(const std::vector<uint8_t>& bytes);
std::optional<std::vector<uint8_t>> from_base64(std::string_view text);

}  // namespace kinora
