// runtime/scene/images/png_memory.cpp: PNG by libpng's simple interface, and base 64.
#include "runtime/scene/images/png_memory.h"

#include <algorithm>

#include "runtime/scene/images/libpng_p.h"

namespace kinora {

namespace {

constexpr std::string_view kDigits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr uint64_t kMostPixels = uint64_t(1) << 28;

}  // namespace

std::vector<uint8_t> encode_png(const Image8& image) {
    if (!libpng().error().empty()) return {};
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = png_uint_32(image.width);
    png.height = png_uint_32(image.height);
    png.format = PNG_FORMAT_RGBA;
    png_alloc_size_t size = 0;
    std::vector<uint8_t> bytes;
    if (!libpng().png_image_write_to_memory(&png, nullptr, &size, 0, image.rgba.data(), 0, nullptr))
        return bytes;
    bytes.resize(size);
    if (!libpng().png_image_write_to_memory(&png, bytes.data(), &size, 0, image.rgba.data(), 0,
                                            nullptr))
        bytes.clear();
    return bytes;
}

std::string base64(const std::vector<uint8_t>& bytes) {
    std::string text;
    for (size_t i = 0; i < bytes.size(); i += 3) {
        const size_t count = std::min<size_t>(3, bytes.size() - i);
        uint32_t word = 0;
        for (size_t k = 0; k < 3; ++k) word = word << 8 | (k < count ? bytes[i + k] : 0u);
        for (size_t k = 0; k < 4; ++k)
            text += k <= count ? kDigits[word >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

std::optional<std::vector<uint8_t>> from_base64(std::string_view text) {
    if (text.size() % 4 != 0) return std::nullopt;
    const size_t padding = text.ends_with("==") ? 2 : text.ends_with('=') ? 1 : 0;
    std::vector<uint8_t> bytes;
    bytes.reserve(text.size() / 4 * 3);
    for (size_t i = 0; i < text.size(); i += 4) {
        const size_t given = i + 4 < text.size() ? 4 : 4 - padding;
        uint32_t word = 0;
        for (size_t k = 0; k < 4; ++k) {
            const size_t digit = k < given ? kDigits.find(text[i + k]) : 0;
            if (digit == kDigits.npos) return std::nullopt;
            word = word << 6 | uint32_t(digit);
        }
        for (size_t k = 0; k + 1 < given; ++k) bytes.push_back(uint8_t(word >> (16 - 8 * k)));
    }
    return bytes;
}

std::optional<Image8> decode_png(std::span<const uint8_t> bytes) {
    if (!libpng().error().empty()) return std::nullopt;
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    if (!libpng().png_image_begin_read_from_memory(&png, bytes.data(), bytes.size()))
        return std::nullopt;
    png.format = PNG_FORMAT_RGBA;
    Image8 image{int(png.width), int(png.height), {}};
    const bool fits = uint64_t(png.width) * png.height <= kMostPixels;
    if (fits) image.rgba.resize(PNG_IMAGE_SIZE(png));
    if (!fits || !libpng().png_image_finish_read(&png, nullptr, image.rgba.data(), 0, nullptr)) {
        libpng().png_image_free(&png);
        return std::nullopt;
    }
    return image;
}

}  // namespace kinora
