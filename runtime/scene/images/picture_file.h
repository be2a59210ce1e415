// runtime/scene/images/picture_file.h: pictures written band by band, so that none of them need be
// in memory as a whole. A file that has its final name is whole.
#pragma once

#include <memory>
#include <string>

#include "runtime/base/files/temporary_file.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

// Rows to one file. Errors are texts, "" for none, with the system's number in `number`.
class RowWriter {
  public:
    virtual ~RowWriter() = default;
    // The next rows, as many as the band has.
    virtual std::string write(const raytrace::Film& band, int& number) = 0;
    // After the last row: all of it is in the file. `checksum`: that which the texts name.
    virtual std::string end(bool checksum, int& number) = 0;
};

// Writes under a temporary name beside `path`, which end() makes the final one when all is on the
// disk. Without end() no file is left. The folder is there already.
class PictureFile {
  public:
    // Of so many rows in all; width and planes are the film's. Formats are write_image()'s.
    std::string begin(const std::string& path, const raytrace::Film& film, int height,
                      ColorEncoding encoding, const ImageTexts& texts,
                      const ExrFormat& format = {});
    // Of 8 bits.
    std::string begin_png(const std::string& path, int width, int height, const ImageTexts& texts);
    std::string write(const raytrace::Film& band);
    std::string write(const Image8& rows);
    // Without its checksum a picture does not pass for the one that its texts say.
    std::string end(bool checksum = true);
    int number() const { return number_; }

  private:
    template <class Make>
    std::string begin_with(const std::string& path, Make&& make);
    std::string failed(std::string error);

    TemporaryFile file_;
    std::unique_ptr<RowWriter> rows_;  // to file_, which outlives it
    int number_ = 0;
};

}  // namespace kinora
