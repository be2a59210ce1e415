// runtime/scene/images/image_io.cpp: pictures to 8 bits, names of files, PNG and EXR back into
// memory.
#include "runtime/scene/images/image_io.h"

#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>

#include "runtime/base/file_extension.h"
#include "runtime/base/files/content_hash.h"
#include "runtime/base/regular_file.h"
#include "runtime/scene/images/exr_module_p.h"
#include "runtime/scene/images/libpng_p.h"
#include "runtime/scene/images/picture_file.h"
#include "runtime/scene/images/picture_rows_p.h"

namespace kinora {

namespace {

float srgb(float x) {
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

uint8_t quantise(float x) {
    if (!(x > 0)) return 0;  // NaN too
    return uint8_t(std::min(x, 1.0f) * 255.0f + 0.5f);
}

// A PNG reader with what must outlive its longjmps.
struct PngError {
    int number = 0;
    std::string text;
};
void on_png_error(png_structp png, png_const_charp text) {
    auto* error = static_cast<PngError*>(libpng().png_get_error_ptr(png));
    error->number = errno;
    error->text = errno ? std::strerror(errno) : text;
    longjmp(*png_jump(png), 1);
}
void on_png_warning(png_structp, png_const_charp) {}

}  // namespace

Image8 to_8_bit(const raytrace::Film& film, ColorEncoding encoding) {
    Image8 image{film.width, film.height, {}};
    image.rgba.resize(film.rgba.size() * 4);
    for (size_t i = 0; i < film.rgba.size(); ++i) {
        const vec4& p = film.rgba[i];
        float scale = p.w > 0 ? 1.0f / p.w : 0.0f;
        for (int k = 0; k < 3; ++k) {
            float c = p[k] * scale;
            if (p.w <= 0) c = p[k];  // light without coverage keeps its colour
            image.rgba[i * 4 + size_t(k)] =
                quantise(encoding == ColorEncoding::Srgb ? srgb(std::max(c, 0.0f)) : c);
        }
        image.rgba[i * 4 + 3] = quantise(p.w);
    }
    return image;
}

bool is_image_path(const std::string& path) {
    return has_extension(path, {".png", ".exr"});
}

std::string try_image_path(const std::string& path, int* errno_out) {
    struct stat target {};
    int number = stat(path.c_str(), &target) == 0 ? 0 : errno;
    if (number == 0) number = S_ISDIR(target.st_mode) ? EISDIR : 0;
    if (number == ENOENT) number = 0;  // the file or its folder, which is found out next
    if (number == 0) number = TemporaryFile().open(path);
    if (errno_out) *errno_out = number;
    return number ? std::strerror(number) : "";
}

namespace {

// The whole picture at once.
template <class Rows>
std::string write_rows(PictureFile& file, std::string error, const Rows& rows, int* errno_out) {
    if (error.empty()) error = file.write(rows);
    if (error.empty()) error = file.end();
    if (errno_out) *errno_out = file.number();
    return error;
}

}  // namespace

std::string write_png(const std::string& path, const Image8& image, const ImageTexts& texts,
                      int* errno_out) {
    PictureFile file;
    return write_rows(file, file.begin_png(path, image.width, image.height, texts), image,
                      errno_out);
}

std::string write_image(const std::string& path, const raytrace::Film& film, ColorEncoding encoding,
                        const ImageTexts& texts, int* errno_out, const ExrFormat& format) {
    PictureFile file;
    return write_rows(file, file.begin(path, film, film.height, encoding, texts, format), film,
                      errno_out);
}

std::string write_image_and_folder(const std::string& path, const raytrace::Film& film,
                                   ColorEncoding encoding, const ImageTexts& texts,
                                   int* errno_out) {
    const int number = make_folder_of(path);
    if (number == 0) return write_image(path, film, encoding, texts, errno_out);
    if (errno_out) *errno_out = number;
    return std::strerror(number);
}

namespace {

// Reads a PNG's header, and its rows when `rows` is given.
bool png_read(std::FILE* file, png_structp png, png_infop info, Image8* rows) {
    if (setjmp(*png_jump(png))) return false;
    libpng().png_init_io(png, file);
    libpng().png_read_info(png, info);
    if (!rows) return true;
    libpng().png_set_expand(png);
    libpng().png_set_strip_16(png);
    libpng().png_set_gray_to_rgb(png);
    libpng().png_set_filler(png, 255, PNG_FILLER_AFTER);
    libpng().png_read_update_info(png, info);
    rows->width = int(libpng().png_get_image_width(png, info));
    rows->height = int(libpng().png_get_image_height(png, info));
    rows->rgba.resize(size_t(rows->width) * size_t(rows->height) * 4);
    for (int y = 0; y < rows->height; ++y)
        libpng().png_read_row(png, &rows->rgba[size_t(y) * size_t(rows->width) * 4], nullptr);
    libpng().png_read_end(png, info);
    return true;
}

// png_read for with_png.
auto png_reader(Image8* rows) {
    return [rows](std::FILE* file, png_structp png, png_infop info) {
        return png_read(file, png, info, rows);
    };
}

// Whether the file ends with PNG's last chunk: one that was cut short does not. Of pictures of our
// own, whose rows are not read; those of others may have bytes behind it.
bool png_has_end(std::FILE* file) {
    constexpr unsigned char kEnd[12] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    unsigned char last[sizeof kEnd];
    bool read = std::fseek(file, -long(sizeof last), SEEK_END) == 0 &&
                std::fread(last, sizeof last, 1, file) == 1;
    std::rewind(file);
    return read && std::memcmp(last, kEnd, sizeof last) == 0;
}

// Opens a PNG and hands it to `use(png, info)` after `read(file, png, info)`, which returns whether
// it could.
template <class Read, class Use>
bool with_png(const std::string& path, Read read, Use use) {
    OpenFile file = open_regular_file(path);
    if (!libpng().error().empty() || !file) return false;
    PngError error;
    png_structp png = libpng().png_create_read_struct(PNG_LIBPNG_VER_STRING, &error, on_png_error,
                                                      on_png_warning);
    png_infop info = libpng().png_create_info_struct(png);
    bool ok = read(file.get(), png, info);
    if (ok) use(png, info);
    libpng().png_destroy_read_struct(&png, &info, nullptr);
    return ok;
}

// Of a file that write_image wrote; else false.
bool hash_png_rows(std::FILE* file, png_structp png, png_infop info, ContentHash& hash,
                   std::vector<uint8_t>& row) {
    if (setjmp(*png_jump(png))) return false;
    libpng().png_init_io(png, file);
    libpng().png_read_info(png, info);
    const size_t bytes = libpng().png_get_rowbytes(png, info);
    if (bytes != size_t(libpng().png_get_image_width(png, info)) * 4) return false;
    row.resize(bytes);
    for (png_uint_32 y = libpng().png_get_image_height(png, info); y > 0; --y) {
        libpng().png_read_row(png, row.data(), nullptr);
        hash.add(row.data(), row.size());
    }
    libpng().png_read_end(png, info);
    return true;
}

std::optional<std::string> find_png_text(png_structp png, png_infop info, const std::string& key) {
    std::optional<std::string> value;
    png_textp texts = nullptr;
    int count = 0;
    libpng().png_get_text(png, info, &texts, &count);
    for (int i = 0; i < count; ++i)
        if (key == texts[i].key) value = texts[i].text;
    return value;
}

bool has_intact_png(const std::string& path) {
    ContentHash hash;
    std::vector<uint8_t> row;
    std::optional<std::string> digits;
    const auto read = [&](std::FILE* file, png_structp png, png_infop info) {
        return hash_png_rows(file, png, info, hash, row);
    };
    return with_png(path, read,
                    [&](png_structp png, png_infop info) {
                        digits = find_png_text(png, info, kChecksumText);
                    }) &&
           digits == hash.digits();
}

std::optional<std::string> read_exr_text(const std::string& path, const std::string& key) {
    const ExrModule& exr = exr_module();
    if (!exr.error().empty()) return std::nullopt;
    auto read = [&](std::string& into) {
        return exr.kinora_exr_text(path.c_str(), key.c_str(), into.data(), into.size() + 1);
    };
    std::string value;
    const int64_t length = read(value);
    if (length < 0) return std::nullopt;
    value.resize(size_t(length));
    if (length > 0) read(value);
    return value;
}

}  // namespace

std::optional<std::string> read_image_text(const std::string& path, const std::string& key) {
    if (has_extension(path, {".exr"})) return read_exr_text(path, key);
    std::optional<std::string> value;
    const auto read = [](std::FILE* file, png_structp png, png_infop info) {
        return png_has_end(file) && png_read(file, png, info, nullptr);
    };
    with_png(path, read,
             [&](png_structp png, png_infop info) { value = find_png_text(png, info, key); });
    return value;
}

bool has_intact_pixels(const std::string& path) {
    if (!has_extension(path, {".exr"})) return has_intact_png(path);
    const std::optional<std::string> digits = read_exr_text(path, kChecksumText);
    if (!digits) return false;
    ContentHash hash;
    const KinoraExrSee see{&hash, [](void* of, const void* bytes, size_t count) {
                               static_cast<ContentHash*>(of)->add(bytes, count);
                           }};
    return exr_module().kinora_exr_see(path.c_str(), &see) == 0 &&
           (*digits == hash.digits() || *digits == kLossyChecksum);
}

std::optional<Image8> read_png(const std::string& path) {
    Image8 image;
    if (!with_png(path, png_reader(&image), [](png_structp, png_infop) {})) return std::nullopt;
    return image;
}

std::optional<Image8> read_image(const std::string& path, ColorEncoding encoding) {
    if (!has_extension(path, {".exr"})) return read_png(path);
    const ExrModule& exr = exr_module();
    KinoraExrPixels pixels;
    if (!exr.error().empty() || exr.kinora_exr_read(path.c_str(), &pixels) != 0)
        return std::nullopt;
    raytrace::Film film;
    film.width = pixels.width;
    film.height = pixels.height;
    film.rgba.resize(size_t(film.width) * size_t(film.height));
    std::memcpy(film.rgba.data(), pixels.rgba, film.rgba.size() * sizeof(vec4));
    exr.kinora_exr_free_pixels(&pixels);
    return to_8_bit(film, encoding);
}

}  // namespace kinora
