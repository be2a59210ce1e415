// runtime/programs/render/frame_writer.cpp: pictures to files, on a thread of their own.
#include "runtime/programs/render/frame_writer.h"

#include <utility>

#include "runtime/base/check.h"
#include "runtime/base/stats.h"

namespace kinora {

namespace {

// The picture last: where it is there, all is. An error is about the frame's `file` then.
WrittenFrame write(WrittenFrame frame) {
    Stopwatch watch;
    for (const DisplayFile& beside : frame.displays) {
        if (!frame.error.empty()) break;
        frame.error = write_display(beside, frame.exposed, frame.film, frame.color, frame.texts,
                                    &frame.number);
        if (!frame.error.empty()) frame.file = beside.path;
    }
    if (frame.error.empty())
        frame.error = write_image(frame.file, frame.film, frame.color, frame.texts, &frame.number,
                                  frame.format);
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
