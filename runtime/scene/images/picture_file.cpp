// runtime/scene/images/picture_file.cpp: pictures under temporary names until they are whole.
#include "runtime/scene/images/picture_file.h"

#include <cstring>

#include "runtime/base/check.h"
#include "runtime/base/file_extension.h"
#include "runtime/scene/images/picture_rows_p.h"

namespace kinora {

// The temporary file never stays.
std::string PictureFile::failed(std::string error) {
    rows_.reset();
    file_.drop();
    return error;
}

template <class Make>
std::string PictureFile::begin_with(const std::string& path, Make&& make) {
    CHECK(!rows_);
    number_ = file_.open(path);
    if (number_) return std::strerror(number_);
    std::string error;
    rows_ = make(error);
    return rows_ ? "" : failed(error);
}

std::string PictureFile::begin(const std::string& path, const raytrace::Film& film, int height,
                               ColorEncoding encoding, const ImageTexts& texts,
                               const ExrFormat& format) {
    return begin_with(path, [&](std::string& error) -> std::unique_ptr<RowWriter> {
        if (has_extension(path, {".exr"}))
            return exr_rows(file_.stream(), path, film, height, format, texts, error, number_);
        return png_rows(file_.stream(), film.width, height, encoding, texts, error, number_);
    });
}

std::string PictureFile::begin_png(const std::string& path, int width, int height,
                                   const ImageTexts& texts) {
    return begin_with(path, [&](std::string& error) {
        return png_rows(file_.stream(), width, height, ColorEncoding::Srgb, texts, error, number_);
    });
}

std::string PictureFile::write(const raytrace::Film& band) {
    std::string error = rows_->write(band, number_);
    return error.empty() ? error : failed(error);
}

std::string PictureFile::write(const Image8& rows) {
    std::string error = static_cast<PngRows&>(*rows_).write(rows, number_);
    return error.empty() ? error : failed(error);
}

std::string PictureFile::end(bool checksum) {
    std::string error = rows_->end(checksum, number_);
    if (!error.empty()) return failed(error);
    rows_.reset();
    number_ = file_.commit();
    return number_ ? std::strerror(number_) : "";
}

}  // namespace kinora
