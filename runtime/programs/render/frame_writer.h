// runtime/programs/render/frame_writer.h: a frame is written while the next one is rendered.
#pragma once

#include <future>
#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/images/display_files.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

// A picture to be written, and how that went.
struct WrittenFrame {
    size_t record = 0;  // the caller's number of the frame
    std::string file;
    ColorEncoding color = ColorEncoding::Srgb;
    ExrFormat format = {};
    ImageTexts texts;
    raytrace::Film film;
    std::vector<DisplayFile> displays = {};  // beside it
    Exposure exposed = {};                   // of the film

    std::string error = {};  // "": it is written
    int number = 0;          // the system's, of the error
    double ms = 0;
};

// One frame at a time.
class FrameWriter {
  public:
    // After finish(). `beside`: on a thread of its own; else it is written when this returns.
    void start(WrittenFrame frame, bool beside);
    // Waits for the frame that was started last; nothing where there is none.
    std::optional<WrittenFrame> finish();

  private:
    std::future<WrittenFrame> pending_;
};

}  // namespace kinora
