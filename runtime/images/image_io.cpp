// runtime/images/image_io.cpp: PNG by libpng, EXR by OpenEXR, names by rename(2).
#include "runtime/images/image_io.h"

#include <fcntl.h>
#include <png.h>
#include <unistd.h>

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>

#include "runtime/base/file_extension.h"
#include "runtime/base/regular_file.h"

namespace kinora {

namespace {

float srgb(float x) {
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
}

uint8_t quantise(float x) {
    if (!(x > 0)) return 0;  // NaN too
    return uint8_t(std::min(x, 1.0f) * 255.0f + 0.5f);
}

using File = OpenFile;

// Everything written so far is on the disk, or the error text.
std::string sync_file(std::FILE* file, int& number) {
    bool ok = !std::ferror(file) && std::fflush(file) == 0 && fsync(fileno(file)) == 0;
    if (!ok) number = errno ? errno : EIO;
    return ok ? "" : std::strerror(number);
}

// A PNG writer or reader with what must outlive its longjmps.
struct PngError {
    int number = 0;
    std::string text;
};
void on_png_error(png_structp png, png_const_charp text) {
    auto* error = static_cast<PngError*>(png_get_error_ptr(png));
    error->number = errno;
    error->text = errno ? std::strerror(errno) : text;
    longjmp(png_jmpbuf(png), 1);
}
void on_png_warning(png_structp, png_const_charp) {}

// libpng's part, without objects whose destructors a longjmp would skip.
bool png_write_rows(png_structp png, png_infop info, std::FILE* file, const Image8& image,
                    png_text* texts, int text_count) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_init_io(png, file);
    png_set_compression_level(png, 3);
    png_set_IHDR(png, info, png_uint_32(image.width), png_uint_32(image.height), 8,
                 PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    png_set_text(png, info, texts, text_count);
    png_write_info(png, info);
    for (int y = 0; y < image.height; ++y)
        png_write_row(png, &image.rgba[size_t(y) * size_t(image.width) * 4]);
    png_write_end(png, info);
    return true;
}

std::string write_png_file(const std::string& path, const Image8& image, const ImageTexts& texts,
                           int& number) {
    errno = 0;
    File file(std::fopen(path.c_str(), "wb"));
    if (!file) {
        number = errno;
        return std::strerror(errno);
    }
    PngError error;
    png_structp png =
        png_create_write_struct(PNG_LIBPNG_VER_STRING, &error, on_png_error, on_png_warning);
    png_infop info = png_create_info_struct(png);
    std::vector<png_text> png_texts;
    for (const auto& [key, value] : texts) {
        png_text text{};
        text.compression = PNG_TEXT_COMPRESSION_NONE;
        text.key = const_cast<char*>(key.c_str());
        text.text = const_cast<char*>(value.c_str());
        png_texts.push_back(text);
    }
    bool ok = png_write_rows(png, info, file.get(), image, png_texts.data(), int(png_texts.size()));
    png_destroy_write_struct(&png, &info);
    number = error.number;
    if (!ok) return error.text;
    return sync_file(file.get(), number);
}

// OpenEXR's own file stream closes without a word when the last bytes cannot be written; errors of
// this one stay in the FILE until sync_file asks for them.
class ExrStream : public Imf::OStream {
  public:
    ExrStream(const std::string& path, std::FILE* file) : OStream(path.c_str()), file_(file) {}
    void write(const char bytes[], int count) override {
        if (std::fwrite(bytes, 1, size_t(count), file_) != size_t(count))
            throw std::runtime_error("write failed");
    }
    uint64_t tellp() override { return uint64_t(std::ftell(file_)); }
    void seekp(uint64_t position) override {
        if (std::fseek(file_, long(position), SEEK_SET) != 0)
            throw std::runtime_error("seek failed");
    }

  private:
    std::FILE* file_;
};

// What is finite stays finite: the largest half is 65504.
float to_half(float x) {
    return std::isfinite(x) ? std::clamp(x, -65504.0f, 65504.0f) : x;
}

// RGBA as half, and each plane of the film as a float channel of its name.
void write_channels(Imf::OStream& stream, Imf::Header& header, const raytrace::Film& film,
                    std::vector<Imf::Rgba>& pixels) {
    Imf::FrameBuffer buffer;
    auto add = [&](const std::string& name, Imf::PixelType type, void* first, size_t step) {
        header.channels().insert(name, Imf::Channel(type));
        buffer.insert(name,
                      Imf::Slice(type, static_cast<char*>(first), step, step * size_t(film.width)));
    };
    add("R", Imf::HALF, &pixels[0].r, sizeof(Imf::Rgba));
    add("G", Imf::HALF, &pixels[0].g, sizeof(Imf::Rgba));
    add("B", Imf::HALF, &pixels[0].b, sizeof(Imf::Rgba));
    add("A", Imf::HALF, &pixels[0].a, sizeof(Imf::Rgba));
    // A parameter that is called like a channel of the picture is R.V there.
    auto channel = [&](const std::string& name) {
        return header.channels().findChannel(name) ? name + ".V" : name;
    };
    for (const raytrace::AovPlane& plane : film.aovs)
        if (plane.in_file)
            add(channel(plane.name), Imf::FLOAT, const_cast<float*>(plane.values.data()),
                sizeof(float));
    Imf::OutputFile file(stream, header, 0);
    file.setFrameBuffer(buffer);
    file.writePixels(film.height);
}

std::string write_exr_file(const std::string& path, const raytrace::Film& film,
                           const ImageTexts& texts, int& number) {
    errno = 0;
    File stream(std::fopen(path.c_str(), "wb"));
    if (!stream) {
        number = errno;
        return std::strerror(errno);
    }
    try {
        Imf::Header header(film.width, film.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        for (const auto& [key, value] : texts) header.insert(key, Imf::StringAttribute(value));
        std::vector<Imf::Rgba> pixels(film.rgba.size());
        for (size_t i = 0; i < pixels.size(); ++i) {
            const vec4& p = film.rgba[i];
            pixels[i] = Imf::Rgba(to_half(p.x), to_half(p.y), to_half(p.z), to_half(p.w));
        }
        ExrStream exr(path, stream.get());
        if (film.aovs.empty()) {
            Imf::RgbaOutputFile file(exr, header, Imf::WRITE_RGBA, 0);
            file.setFrameBuffer(pixels.data(), 1, size_t(film.width));
            file.writePixels(film.height);
        } else {
            write_channels(exr, header, film, pixels);
        }
    } catch (const std::exception& error) {
        number = errno;
        return errno ? std::strerror(errno) : error.what();
    }
    return sync_file(stream.get(), number);
}

namespace fs = std::filesystem;

// Where a picture is until it is whole: ".NAME.PID.tmp" beside it.
std::string temporary_name(const fs::path& target) {
    return (target.parent_path() /
            ("." + target.filename().string() + "." + std::to_string(getpid()) + ".tmp"))
        .string();
}

std::string make_folder(const fs::path& target, int& number) {
    std::error_code code;
    if (target.has_parent_path()) fs::create_directories(target.parent_path(), code);
    number = code.value();
    return code ? code.message() : "";
}

// Calls write(temporary name), then renames; the temporary file never stays.
template <class Write>
std::string write_whole(const std::string& path, int* errno_out, Write write) {
    int number = 0;
    std::string error = make_folder(path, number);
    if (error.empty()) {
        std::string temporary = temporary_name(path);
        error = write(temporary, number);
        if (error.empty() && std::rename(temporary.c_str(), path.c_str()) != 0) {
            number = errno;
            error = std::strerror(errno);
        }
        if (!error.empty()) unlink(temporary.c_str());
    }
    if (errno_out) *errno_out = number;
    return error;
}

// The process of ".NAME.PID.tmp", 0 if the name is not so.
pid_t writer_of(const std::string& name) {
    if (!name.starts_with(".") || !name.ends_with(".tmp")) return 0;
    std::string stem = name.substr(0, name.size() - 4);
    size_t dot = stem.rfind('.');
    if (!is_image_path(stem.substr(1, dot - 1))) return 0;
    int pid = 0;
    auto [end, error] = std::from_chars(stem.data() + dot + 1, stem.data() + stem.size(), pid);
    return error == std::errc() && end == stem.data() + stem.size() ? pid : 0;
}

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
    int number = 0;
    std::string error = make_folder(path, number);
    std::error_code ignored;
    if (error.empty() && fs::is_directory(path, ignored)) {
        number = EISDIR;
        error = std::strerror(EISDIR);
    }
    if (error.empty()) {
        std::string temporary = temporary_name(path);
        int file = open(temporary.c_str(), O_WRONLY | O_CREAT, 0666);
        number = file < 0 ? errno : 0;
        if (file < 0) error = std::strerror(errno);
        if (file >= 0) {
            close(file);
            unlink(temporary.c_str());
        }
    }
    if (errno_out) *errno_out = number;
    return error;
}

void remove_stale_images(const std::string& path) {
    fs::path folder = fs::path(path).parent_path();
    std::error_code code;
    for (fs::directory_iterator at(folder.empty() ? "." : folder, code), end; !code && at != end;
         at.increment(code)) {
        pid_t writer = writer_of(at->path().filename().string());
        if (writer <= 0 || kill(writer, 0) == 0 || errno != ESRCH) continue;
        std::error_code ignored;
        auto age = fs::file_time_type::clock::now() - fs::last_write_time(at->path(), ignored);
        if (!ignored && age > std::chrono::minutes(1)) fs::remove(at->path(), ignored);
    }
}

std::string write_png(const std::string& path, const Image8& image, const ImageTexts& texts,
                      int* errno_out) {
    return write_whole(path, errno_out, [&](const std::string& temporary, int& number) {
        return write_png_file(temporary, image, texts, number);
    });
}

std::string write_image(const std::string& path, const raytrace::Film& film, ColorEncoding encoding,
                        const ImageTexts& texts, int* errno_out) {
    if (has_extension(path, {".exr"}))
        return write_whole(path, errno_out, [&](const std::string& temporary, int& number) {
            return write_exr_file(temporary, film, texts, number);
        });
    return write_png(path, to_8_bit(film, encoding), texts, errno_out);
}

namespace {

// Reads a PNG's header, and its rows when `rows` is given.
bool png_read(std::FILE* file, png_structp png, png_infop info, Image8* rows) {
    if (setjmp(png_jmpbuf(png))) return false;
    png_init_io(png, file);
    png_read_info(png, info);
    if (!rows) return true;
    png_set_expand(png);
    png_set_strip_16(png);
    png_set_gray_to_rgb(png);
    png_set_filler(png, 255, PNG_FILLER_AFTER);
    png_read_update_info(png, info);
    rows->width = int(png_get_image_width(png, info));
    rows->height = int(png_get_image_height(png, info));
    rows->rgba.resize(size_t(rows->width) * size_t(rows->height) * 4);
    for (int y = 0; y < rows->height; ++y)
        png_read_row(png, &rows->rgba[size_t(y) * size_t(rows->width) * 4], nullptr);
    png_read_end(png, info);
    return true;
}

// Whether the file ends with PNG's last chunk: one that was cut short does not.
bool png_has_end(std::FILE* file) {
    constexpr unsigned char kEnd[12] = {0, 0, 0, 0, 'I', 'E', 'N', 'D', 0xae, 0x42, 0x60, 0x82};
    unsigned char last[sizeof kEnd];
    bool read = std::fseek(file, -long(sizeof last), SEEK_END) == 0 &&
                std::fread(last, sizeof last, 1, file) == 1;
    std::rewind(file);
    return read && std::memcmp(last, kEnd, sizeof last) == 0;
}

// Opens a PNG and hands it to `use(png, info)` after png_read.
template <class Use>
bool with_png(const std::string& path, Image8* rows, Use use) {
    OpenFile file = open_regular_file(path);
    if (!file || !png_has_end(file.get())) return false;
    PngError error;
    png_structp png =
        png_create_read_struct(PNG_LIBPNG_VER_STRING, &error, on_png_error, on_png_warning);
    png_infop info = png_create_info_struct(png);
    bool ok = png_read(file.get(), png, info, rows);
    if (ok) use(png, info);
    png_destroy_read_struct(&png, &info, nullptr);
    return ok;
}

}  // namespace

std::optional<std::string> read_image_text(const std::string& path, const std::string& key) {
    if (has_extension(path, {".exr"})) {
        try {
            Imf::RgbaInputFile file(path.c_str());
            if (!file.isComplete()) return std::nullopt;
            // A file cut short throws where its last rows should be.
            Imath::Box2i window = file.dataWindow();
            std::vector<Imf::Rgba> row(size_t(window.max.x - window.min.x) + 1);
            file.setFrameBuffer(row.data() - window.min.x, 1, 0);
            file.readPixels(window.max.y);
            const auto* text = file.header().findTypedAttribute<Imf::StringAttribute>(key);
            return text ? std::optional(text->value()) : std::nullopt;
        } catch (const std::exception&) {
            return std::nullopt;
        }
    }
    std::optional<std::string> value;
    with_png(path, nullptr, [&](png_structp png, png_infop info) {
        png_textp texts = nullptr;
        int count = 0;
        png_get_text(png, info, &texts, &count);
        for (int i = 0; i < count; ++i)
            if (key == texts[i].key) value = texts[i].text;
    });
    return value;
}

std::optional<Image8> read_png(const std::string& path) {
    Image8 image;
    if (!with_png(path, &image, [](png_structp, png_infop) {})) return std::nullopt;
    return image;
}

std::optional<Image8> read_image(const std::string& path, ColorEncoding encoding) {
    if (!has_extension(path, {".exr"})) return read_png(path);
    try {
        Imf::RgbaInputFile file(path.c_str());
        Imath::Box2i window = file.dataWindow();
        raytrace::Film film;
        film.width = window.max.x - window.min.x + 1;
        film.height = window.max.y - window.min.y + 1;
        std::vector<Imf::Rgba> row(size_t(film.width));
        for (int y = window.min.y; y <= window.max.y; ++y) {
            file.setFrameBuffer(row.data() - window.min.x, 1, 0);
            file.readPixels(y);
            for (const Imf::Rgba& p : row) film.rgba.push_back(vec4(p.r, p.g, p.b, p.a));
        }
        return to_8_bit(film, encoding);
    } catch (const std::exception&) {
        return std::nullopt;
    }
}

}  // namespace kinora
