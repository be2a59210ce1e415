// runtime/scene/images/png_rows.cpp: rows of a PNG, by libpng.
#include <cerrno>
#include <cstring>

#include "runtime/base/files/content_hash.h"
#include "runtime/scene/images/libpng_p.h"
#include "runtime/scene/images/picture_rows_p.h"

namespace kinora {

namespace {

// What must outlive libpng's longjmps.
struct PngFault {
    int number = 0;
    std::string text;
};
void on_png_fault(png_structp png, png_const_charp text) {
    auto* fault = static_cast<PngFault*>(libpng().png_get_error_ptr(png));
    fault->number = errno;
    fault->text = errno ? std::strerror(errno) : text;
    longjmp(*png_jump(png), 1);
}
void on_png_note(png_structp, png_const_charp) {}

// libpng's part, without objects whose destructors a longjmp would skip.
bool begin_png_rows(png_structp png, png_infop info, std::FILE* file, int width, int height,
                    png_text* texts, int text_count) {
    if (setjmp(*png_jump(png))) return false;
    libpng().png_init_io(png, file);
    libpng().png_set_compression_level(png, 3);
    libpng().png_set_IHDR(png, info, png_uint_32(width), png_uint_32(height), 8,
                          PNG_COLOR_TYPE_RGBA, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                          PNG_FILTER_TYPE_DEFAULT);
    libpng().png_set_text(png, info, texts, text_count);
    libpng().png_write_info(png, info);
    return true;
}
bool put_png_rows(png_structp png, const Image8& image) {
    if (setjmp(*png_jump(png))) return false;
    for (int y = 0; y < image.height; ++y)
        libpng().png_write_row(png, &image.rgba[size_t(y) * size_t(image.width) * 4]);
    return true;
}
// Texts that were set since the header was written stand behind the rows.
bool end_png_rows(png_structp png, png_infop info, png_text* texts, int text_count) {
    if (setjmp(*png_jump(png))) return false;
    libpng().png_set_text(png, info, texts, text_count);
    libpng().png_write_end(png, info);
    return true;
}

png_text plain_text(const std::string& key, const std::string& value) {
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = const_cast<char*>(key.c_str());
    text.text = const_cast<char*>(value.c_str());
    return text;
}

class PngRowsToFile final : public PngRows {
  public:
    PngRowsToFile(std::FILE* file, ColorEncoding encoding) : file_(file), encoding_(encoding) {
        png_ = libpng().png_create_write_struct(PNG_LIBPNG_VER_STRING, &fault_, on_png_fault,
                                                on_png_note);
        info_ = libpng().png_create_info_struct(png_);
    }
    ~PngRowsToFile() override { libpng().png_destroy_write_struct(&png_, &info_); }

    std::string begin(int width, int height, const ImageTexts& texts, int& number) {
        std::vector<png_text> png_texts;
        for (const auto& [key, value] : texts) {
            wants_checksum_ |= key == kChecksumText;
            if (key != kChecksumText) png_texts.push_back(plain_text(key, value));
        }
        errno = 0;
        return told(begin_png_rows(png_, info_, file_, width, height, png_texts.data(),
                                   int(png_texts.size())),
                    number);
    }
    std::string write(const raytrace::Film& band, int& number) override {
        return write(to_8_bit(band, encoding_), number);
    }
    std::string write(const Image8& rows, int& number) override {
        errno = 0;
        if (wants_checksum_) hash_.add(rows.rgba.data(), rows.rgba.size());
        return told(put_png_rows(png_, rows), number);
    }
    std::string end(bool checksum, int& number) override {
        errno = 0;
        const std::string key = kChecksumText, digits = hash_.digits();
        png_text text = plain_text(key, digits);
        return told(end_png_rows(png_, info_, &text, wants_checksum_ && checksum), number);
    }

  private:
    std::string told(bool good, int& number) const {
        if (good) return "";
        number = fault_.number;
        return fault_.text;
    }

    std::FILE* file_;
    ColorEncoding encoding_;
    bool wants_checksum_ = false;
    ContentHash hash_;
    PngFault fault_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
};

}  // namespace

std::unique_ptr<PngRows> png_rows(std::FILE* file, int width, int height, ColorEncoding encoding,
                                  const ImageTexts& texts, std::string& error, int& number) {
    error = libpng().error();
    if (!error.empty()) return nullptr;
    auto rows = std::make_unique<PngRowsToFile>(file, encoding);
    error = rows->begin(width, height, texts, number);
    if (!error.empty()) rows.reset();
    return rows;
}

}  // namespace kinora
