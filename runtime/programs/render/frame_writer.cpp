// runtime/programs/render/frame_writer.cpp: pictures to files, on a thread of their own.
#include "runtime/programs/render/frame_writer.h"

#include <utility>

#include "runtime/base/check.h"
#include "runtime/base/stats.h"

namespace kinora {

namespace {

WrittenFrame write(WrittenFrame frame) {
    Stopwatch watch;
    frame.error = write_image(frame.file, frame.film, frame.color, frame.texts, &frame.number,
                              frame.depth);
    frame.ms = watch.ms();
    return frame;
}

}  // namespace

void FrameWriter::start(WrittenFrame frame, bool beside) {
    CHECK(!pending_.valid());
    pending_ =
        std::async(beside ? std::launch::async : std::launch::deferred, write, std::move(frame));
    if (!beside) pending_.wait();
}

std::optional<WrittenFrame> FrameWriter::finish() {
    if (!pending_.valid()) return {};
    return pending_.get();
}

}  // namespace kinora
