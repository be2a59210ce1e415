// collada/extract/embedded_image.cpp: image files that stand in a document as hexadecimal digits.
#include <filesystem>
#include <fstream>

#include "collada/document/archive.h"
#include "collada/extract/extract_p.h"
#include "collada/text/numbers_p.h"
#include "runtime/base/display_path.h"

namespace kinora::collada {

namespace {

struct ImageMagic {
    std::string_view bytes;
    const char* extension;
};
constexpr ImageMagic kImages[] = {{"\x89PNG", "png"},
                                  {"\xff\xd8\xff", "jpg"},
                                  {"DDS ", "dds"},
                                  {"BM", "bmp"},
                                  {std::string_view("II*\0", 4), "tif"},
                                  {std::string_view("MM\0*", 4), "tif"},
                                  {"GIF8", "gif"},
                                  {"v/1\x01", "exr"},
                                  {"#?", "hdr"}};

// By what the bytes are, else a format that has no mark of its own.
std::string extension_of(std::string_view bytes, std::string_view format) {
    for (const ImageMagic& row : kImages)
        if (bytes.starts_with(row.bytes)) return row.extension;
    return format == "TGA" || format == "tga" ? "tga" : "";
}

int digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

// White space between digits does not count; anything else ends it.
std::string bytes_of_hex(std::string_view text) {
    std::string bytes;
    bytes.reserve(text.size() / 2);
    int high = -1;
    for (char c : text) {
        int value = digit(c);
        if (value < 0 && !std::isspace(uint8_t(c))) return {};
        if (value < 0) continue;
        if (high >= 0) bytes += char(high * 16 + value);
        high = high >= 0 ? -1 : value;
    }
    return bytes;
}

// One folder for all images of a scene: the only thing that scene.files holds.
std::shared_ptr<const PrivateFolder> image_folder(Extraction& x, uint32_t doc) {
    if (!x.scene.files.empty())
        return std::static_pointer_cast<const PrivateFolder>(x.scene.files.front());
    std::string error;
    auto folder = PrivateFolder::make(error);
    if (!folder) return nullptr;
    show_folder_as(folder->path(), x.document(doc).path() + "#");
    x.scene.files.push_back(folder);
    return folder;
}

}  // namespace

std::string unpack_image(Extraction& x, Link data, std::string_view format, std::string_view id) {
    std::string bytes = bytes_of_hex(data.element->text);
    std::string extension = extension_of(bytes, format);
    auto folder = extension.empty() ? nullptr : image_folder(x, data.doc);
    if (!folder) {
        x.diag.report(Code::IMAGE_EMBEDDED, x.where(data), id);
        return {};
    }
    std::string path =
        fmt::format("{}/image{}.{}", folder->path(), x.scene.images.size(), extension);
    std::ofstream(path, std::ios::binary) << bytes;
    std::error_code ignored;  // no time of its own: a picture's fingerprint is the document's
    std::filesystem::last_write_time(path, std::filesystem::file_time_type(), ignored);
    x.diag.report(Code::IMAGE_UNPACKED, x.where(data), id, bytes.size(), extension);
    return path;
}

}  // namespace kinora::collada
