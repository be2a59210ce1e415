// runtime/images/picture_file.cpp: pictures under temporary names until they are whole.
#include "runtime/images/picture_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "runtime/base/check.h"
#include "runtime/base/file_extension.h"
#include "runtime/images/picture_rows_p.h"

namespace kinora {

std::string sync_file(std::FILE* file, int& number) {
    bool ok = !std::ferror(file) && std::fflush(file) == 0 && fsync(fileno(file)) == 0;
    if (!ok) number = errno ? errno : EIO;
    return ok ? "" : std::strerror(number);
}

std::string temporary_picture(const std::string& path, std::string& error, int& number) {
    const std::filesystem::path target(path);
    std::error_code code;
    if (target.has_parent_path()) std::filesystem::create_directories(target.parent_path(), code);
    number = code.value();
    error = code ? code.message() : "";
    return (target.parent_path() /
            ("." + target.filename().string() + "." + std::to_string(getpid()) + ".tmp"))
        .string();
}

PictureFile::~PictureFile() {
    rows_.reset();
    if (!temporary_.empty()) unlink(temporary_.c_str());
}

// The temporary file never stays.
std::string PictureFile::failed(std::string error) {
    rows_.reset();
    unlink(temporary_.c_str());
    temporary_.clear();
    return error;
}

template <class Make>
std::string PictureFile::begin_with(const std::string& path, Make&& make) {
    CHECK(!rows_);
    path_ = path;
    number_ = 0;
    std::string error;
    temporary_ = temporary_picture(path, error, number_);
    if (error.empty()) rows_ = make(error);
    return rows_ ? "" : failed(error);
}

std::string PictureFile::begin(const std::string& path, const raytrace::Film& film, int height,
                               ColorEncoding encoding, const ImageTexts& texts,
                               PictureDepth depth) {
    return begin_with(path, [&](std::string& error) -> std::unique_ptr<RowWriter> {
        if (has_extension(path, {".exr"}))
            return exr_rows(temporary_, film, height, depth, texts, error, number_);
        return png_rows(temporary_, film.width, height, encoding, texts, error, number_);
    });
}

std::string PictureFile::begin_png(const std::string& path, int width, int height,
                                   const ImageTexts& texts) {
    return begin_with(path, [&](std::string& error) {
        return png_rows(temporary_, width, height, ColorEncoding::Srgb, texts, error, number_);
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

std::string PictureFile::end() {
    std::string error = rows_->end(number_);
    if (!error.empty()) return failed(error);
    rows_.reset();
    if (std::rename(temporary_.c_str(), path_.c_str()) != 0) {
        number_ = errno;
        return failed(std::strerror(number_));
    }
    temporary_.clear();
    return "";
}

}  // namespace kinora
