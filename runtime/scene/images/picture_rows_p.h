// runtime/scene/images/picture_rows_p.h: the formats of picture_file.h.
#pragma once

#include "runtime/scene/images/picture_file.h"

namespace kinora {

// 8-bit RGBA; write() encodes and quantises the film's colours.
class PngRows : public RowWriter {
  public:
    virtual std::string write(const Image8& rows, int& number) = 0;
    using RowWriter::write;
};

// To an open file, which stays the caller's. Null with the text in `error`, where the header cannot
// be written. Errors of the module name the file by `path`.
std::unique_ptr<PngRows> png_rows(std::FILE* file, int width, int height, ColorEncoding encoding,
                                  const ImageTexts& texts, std::string& error, int& number);
std::unique_ptr<RowWriter> exr_rows(std::FILE* file, const std::string& path,
                                    const raytrace::Film& film, int height, const ExrFormat& format,
                                    const ImageTexts& texts, std::string& error, int& number);

}  // namespace kinora
