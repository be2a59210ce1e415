// runtime/programs/render/band_writer.h: pictures too large for memory, written while they are
// rendered.
#pragma once

#include <optional>

#include "runtime/programs/render/frame_writer.h"
#include "runtime/scene/images/picture_file.h"

namespace kinora {

// Rows of a picture of that size to be held at a time, a multiple of `tile`; 0: all of it, as of
// pictures of up to 2^25 pixels.
int band_rows(int width, int height, int tile);

// One frame at a time.
class BandWriter {
  public:
    // A frame without a file is only rendered.
    // Before the first band: what its header is to say.
    void describe(std::vector<ExrAttribute> attributes) {
        frame_.format.attributes = std::move(attributes);
    }
    void start(WrittenFrame frame, int height);
    // The next band, from the top; false once something could not be written.
    bool take(const raytrace::Film& band);
    // After the last band: how it went. `whole`: all bands came; else no file is left. `checksum`:
    // that which the texts name is put in.
    WrittenFrame finish(bool whole, bool checksum);

  private:
    WrittenFrame frame_;
    int height_ = 0;
    std::optional<PictureFile> file_;
};

}  // namespace kinora
