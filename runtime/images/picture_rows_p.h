// runtime/images/picture_rows_p.h: the formats of picture_file.h.
#pragma once

#include "runtime/images/picture_file.h"

namespace kinora {

// 8-bit RGBA; write() encodes and quantises the film's colours.
class PngRows : public RowWriter {
  public:
    virtual std::string write(const Image8& rows, int& number) = 0;
    using RowWriter::write;
};

// Null with the text in `error`, where the file cannot be opened.
std::unique_ptr<PngRows> png_rows(const std::string& path, int width, int height,
                                  ColorEncoding encoding, const ImageTexts& texts,
                                  std::string& error, int& number);
std::unique_ptr<RowWriter> exr_rows(const std::string& path, const raytrace::Film& film, int height,
                                    PictureDepth depth, const ImageTexts& texts,
                                    std::string& error, int& number);

// Everything written so far is on the disk, or the error text.
std::string sync_file(std::FILE* file, int& number);

// For a picture that is not whole yet: ".NAME.PID.tmp" beside it. The folder is made.
std::string temporary_picture(const std::string& path, std::string& error, int& number);

}  // namespace kinora
