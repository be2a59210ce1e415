// runtime/scene/images/texture_image.cpp: image files to pixels: PNG by libpng, the rest by the
// module.
#include "runtime/scene/images/texture_image.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <memory>
#include <new>
#include <optional>

#include "runtime/base/images_module/images_module.h"
#include "runtime/base/regular_file.h"
#include "runtime/base/shared_library.h"
#include "runtime/scene/description/memory_file.h"
#include "runtime/scene/images/image_io.h"
#include "runtime/scene/images/libpng_p.h"

namespace kinora {

namespace {

// The module's functions, or why there are none. OpenImageIO does not survive being unloaded.
struct ImagesModule : SharedLibrary {
    ImagesModule()
        : SharedLibrary(module_path("libkinora_images.so"), "images other than PNG are read",
                        "libopenimageio2.4") {}

    KINORA_FUNCTION(kinora_decode_image);
    KINORA_FUNCTION(kinora_free_image);
};

const ImagesModule& images_module() {
    return opened<ImagesModule>();
}

constexpr size_t kPngHeader = 29;  // signature, then IHDR: width 16, height 20, depth 24, method 28
using Header = std::array<unsigned char, kPngHeader>;

uint64_t big_endian_32(const unsigned char* at) {
    return uint64_t(at[0]) << 24 | uint64_t(at[1]) << 16 | uint64_t(at[2]) << 8 | at[3];
}

bool is_png(const Header& header) {
    return std::memcmp(header.data(), "\x89PNG\r\n\x1a\n", 8) == 0;
}

// At most 8 bits, not interlaced: what read_png reads whole.
bool is_plain_png(const Header& header) {
    return is_png(header) && header[24] <= 8 && header[28] == 0;
}

// The start of the file, zeros beyond its end; or why it cannot be had.
std::string read_header(const std::string& path, Header& header) {
    std::string error;
    OpenFile file = open_regular_file(path, &error);
    if (!file) return error;
    header.fill(0);
    if (std::fread(header.data(), 1, header.size(), file.get()) == 0) return "the file is empty";
    return "";
}

// Why an image of this size is refused, or "".
std::string refuse_size(uint64_t width, uint64_t height) {
    bool fits = std::max(width, height) <= kMaxTextureSide && width * height <= kMaxTexturePixels;
    if (fits) return "";
    return "it is too large, " + std::to_string(width) + " x " + std::to_string(height) + " pixels";
}

// Of a PNG file by its colour type (PNG specification, 11.2.2); one more where it has tRNS.
int png_channels(const Header& header, const std::vector<uint8_t>& rgba) {
    constexpr int kGreyAlpha = 4, kRgba = 6;
    int type = header[25];
    int colors = type == 0 || type == kGreyAlpha ? 1 : 3;
    bool alpha = type == kGreyAlpha || type == kRgba;
    for (size_t i = 3; !alpha && i < rgba.size(); i += 4) alpha = rgba[i] != 255;
    return colors + alpha;
}

std::string read_plain_png(const std::string& path, const Header& header, TextureImage& image) {
    std::optional<Image8> pixels = read_png(path);
    if (!libpng().error().empty()) return libpng().error();
    if (!pixels) return "the PNG file is damaged";
    image.width = pixels->width;
    image.height = pixels->height;
    image.encoded = true;
    image.bytes = std::move(pixels->rgba);
    image.facts.width = image.width, image.facts.height = image.height;
    image.facts.channels = png_channels(header, image.bytes);
    return "";
}

// Where each of r g b a comes from: a channel of the file, or -1 (0 for colours, 1 for alpha).
struct ChannelMap {
    int from[4] = {-1, -1, -1, -1};
    int colors = 0;
};
ChannelMap channel_map(int channels, int alpha) {
    ChannelMap map;
    for (int c = 0; c < channels && map.colors < 3; ++c)
        if (c != alpha) map.from[map.colors++] = c;
    map.from[3] = alpha;
    bool grey = map.colors == 1;
    if (grey) {
        map.from[1] = map.from[2] = map.from[0];
        map.colors = 3;
    }
    return map;
}

template <class T>
void expand(const KinoraImage& source, const ChannelMap& map, T one, std::vector<T>& rgba) {
    size_t pixels = size_t(source.width) * size_t(source.height);
    rgba.resize(pixels * 4);
    const T* in = static_cast<const T*>(source.pixels);
    for (size_t i = 0; i < pixels; ++i, in += source.channels)
        for (int c = 0; c < 4; ++c)
            rgba[i * 4 + size_t(c)] = map.from[c] >= 0 ? in[map.from[c]] : c == 3 ? one : T(0);
}

TextureFacts facts_of(const KinoraImage& source) {
    constexpr const char* kTypes[] = {"texture", "environment", "shadow"};
    TextureFacts facts;
    facts.width = source.width, facts.height = source.height;
    facts.channels = source.file_channels;
    facts.type = kTypes[source.kind];
    facts.has_matrices = source.has_matrices != 0;
    std::copy_n(source.world_to_camera, 16, facts.world_to_camera.begin());
    std::copy_n(source.world_to_screen, 16, facts.world_to_screen.begin());
    return facts;
}

std::string first_line(const std::string& text) {
    return text.substr(0, text.find('\n'));
}

std::string read_by_module(const std::string& path, TextureImage& image) {
    const ImagesModule& module = images_module();
    if (!module.error().empty()) return module.error();
    KinoraImage source;
    if (module.kinora_decode_image(path.c_str(), kMaxTexturePixels, &source) != 0)
        return source.error[0] ? first_line(source.error) : "unknown format";
    std::unique_ptr<KinoraImage, decltype(module.kinora_free_image)> owner(
        &source, module.kinora_free_image);
    std::string refused = refuse_size(uint64_t(source.width), uint64_t(source.height));
    if (!refused.empty()) return refused;
    image.width = source.width;
    image.height = source.height;
    image.encoded = source.encoded != 0;
    image.by_module = true;
    image.facts = facts_of(source);
    ChannelMap map = channel_map(source.channels, source.alpha_channel);
    image.colors = std::max(map.colors, 1);
    if (source.is_float)
        expand(source, map, 1.0f, image.floats);
    else
        expand(source, map, uint8_t(255), image.bytes);
    return "";
}

}  // namespace

std::string read_texture_image(const std::string& name, TextureImage& image) {
    image = {};
    FileToOpen file(name);
    const std::string& path = file.path();
    Header header;
    if (std::string error = read_header(path, header); !error.empty()) return error;
    const char* first = reinterpret_cast<const char*>(header.data());
    if (const char* what = disguise_of({first, header.size()})) return what;
    try {
        if (is_png(header)) {
            uint64_t width = big_endian_32(&header[16]), height = big_endian_32(&header[20]);
            if (std::string error = refuse_size(width, height); !error.empty()) return error;
        }
        return is_plain_png(header) ? read_plain_png(path, header, image)
                                    : read_by_module(path, image);
    } catch (const std::bad_alloc&) {
        return "not enough memory";
    }
}

TextureImage image_rows(const TextureImage& image, int from, int rows) {
    TextureImage part;
    part.width = image.width, part.height = rows;
    part.colors = image.colors, part.encoded = image.encoded;
    auto begin = long(from) * image.width * 4, end = long(from + rows) * image.width * 4;
    if (image.is_float())
        part.floats.assign(image.floats.begin() + begin, image.floats.begin() + end);
    else
        part.bytes.assign(image.bytes.begin() + begin, image.bytes.begin() + end);
    return part;
}

TextureImage checks_image() {
    TextureImage image;
    image.width = image.height = 8;
    for (int i = 0; i < 64; ++i) {
        uint8_t on = ((i & 7) + (i >> 3)) & 1 ? 255 : 0;
        image.bytes.insert(image.bytes.end(), {on, 0, on, 255});
    }
    return image;
}

}  // namespace kinora
