// runtime/programs/tradeoff/png_memory.h: pictures as bytes of a page.
#pragma once

#include <string>

#include "runtime/images/image_io.h"

namespace kinora {

std::vector<uint8_t> encode_png(const Image8& image);
std::string base64(const std::vector<uint8_t>& bytes);  // RFC 4648, section 4

}  // namespace kinora
