// runtime/programs/validate/image_size.cpp: one row a format: its mark and where width and height
// stand.
#include "runtime/programs/validate/image_size.h"

#include "runtime/base/file_extension.h"
#include "runtime/base/regular_file.h"

namespace kinora {

namespace {

constexpr size_t kHeadBytes = 1 << 20;  // JPEG's size may stand behind a thumbnail and profiles

// Bytes of a head; reading past its end gives 0.
struct Head {
    std::string_view bytes;
    bool big_endian = false;

    uint32_t byte(size_t at) const { return at < bytes.size() ? uint8_t(bytes[at]) : 0; }
    uint32_t u16(size_t at) const {
        return big_endian ? byte(at) << 8 | byte(at + 1) : byte(at + 1) << 8 | byte(at);
    }
    uint32_t u32(size_t at) const {
        return big_endian ? u16(at) << 16 | u16(at + 2) : u16(at + 2) << 16 | u16(at);
    }
};

using Size = std::optional<ImageSize>;

Size png(Head h) {
    h.big_endian = true;
    return ImageSize{h.u32(16), h.u32(20), "png"};
}

// ITU T.81: segments FF xx length; the frame header is C0..CF but for C4, C8 and CC.
Size jpeg(Head h) {
    h.big_endian = true;
    for (size_t at = 2; at + 8 < h.bytes.size();) {
        if (h.byte(at) != 0xFF) return std::nullopt;
        uint32_t marker = h.byte(at + 1);
        if (marker == 0xFF) {
            ++at;
            continue;
        }
        bool frame =
            marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        if (frame) return ImageSize{h.u16(at + 7), h.u16(at + 5), "jpeg"};
        at += 2 + h.u16(at + 2);
    }
    return std::nullopt;
}

Size gif(Head h) {
    return ImageSize{h.u16(6), h.u16(8), "gif"};
}
Size bmp(Head h) {
    int32_t height = int32_t(h.u32(22));  // negative: top row first
    return ImageSize{h.u32(18), uint32_t(height < 0 ? -int64_t(height) : height), "bmp"};
}
Size dds(Head h) {
    return ImageSize{h.u32(16), h.u32(12), "dds"};
}
Size psd(Head h) {
    h.big_endian = true;
    return ImageSize{h.u32(18), h.u32(14), "psd"};
}

// TIFF 6.0: the first directory's ImageWidth (256) and ImageLength (257), SHORT or LONG.
Size tiff(Head h) {
    h.big_endian = h.byte(0) == 'M';
    ImageSize size{0, 0, "tiff"};
    size_t at = h.u32(4);
    for (uint32_t entry = 0, count = h.u16(at); entry < count; ++entry) {
        size_t field = at + 2 + entry * size_t(12);
        uint32_t value = h.u16(field + 2) == 3 ? h.u16(field + 8) : h.u32(field + 8);
        if (h.u16(field) == 256) size.width = value;
        if (h.u16(field) == 257) size.height = value;
    }
    if (!size.width || !size.height) return std::nullopt;
    return size;
}

// OpenEXR file layout: attributes "name\0type\0size value"; dataWindow is xMin yMin xMax yMax.
Size exr(Head h) {
    for (size_t at = 8; at < h.bytes.size() && h.byte(at);) {
        size_t name_end = h.bytes.find('\0', at);
        size_t type_end = name_end == h.bytes.npos ? name_end : h.bytes.find('\0', name_end + 1);
        if (type_end == h.bytes.npos) return std::nullopt;
        size_t value = type_end + 5;
        if (h.bytes.substr(at, name_end - at) == "dataWindow")
            return ImageSize{h.u32(value + 8) - h.u32(value) + 1,
                             h.u32(value + 12) - h.u32(value + 4) + 1, "exr"};
        at = value + h.u32(type_end + 1);
    }
    return std::nullopt;
}

struct Format {
    std::string_view mark;
    Size (*size)(Head);
};
constexpr Format kFormats[] = {
    {"\x89PNG\r\n\x1a\n", png},
    {"\xFF\xD8\xFF", jpeg},
    {"GIF8", gif},
    {"BM", bmp},
    {"DDS ", dds},
    {"8BPS", psd},
    {std::string_view("II*\0", 4), tiff},
    {std::string_view("MM\0*", 4), tiff},
    {"\x76\x2f\x31\x01", exr},
};

}  // namespace

std::optional<ImageSize> image_size_of_bytes(std::string_view head, std::string_view name) {
    for (const Format& format : kFormats)
        if (head.starts_with(format.mark)) return format.size({head});
    Head h{head};
    if (has_extension(name, {".tga"}) && head.size() >= 18)  // TGA has no mark
        return ImageSize{h.u16(12), h.u16(14), "tga"};
    return std::nullopt;
}

std::optional<ImageSize> image_size(const std::string& path) {
    if (path.empty()) return std::nullopt;
    OpenFile file = open_regular_file(path);
    std::string head(kHeadBytes, '\0');
    head.resize(file ? std::fread(head.data(), 1, head.size(), file.get()) : 0);
    return image_size_of_bytes(head, path);
}

}  // namespace kinora
