// runtime/programs/render/band_writer.cpp: bands of a picture to its file.
#include "runtime/programs/render/band_writer.h"

#include <algorithm>
#include <utility>

#include "runtime/base/stats.h"

namespace kinora {

int band_rows(int width, int height, int tile) {
    constexpr int64_t kWhole = 1 << 25, kBand = 1 << 23;  // pixels; 16 bytes each, and 4 to write
    if (int64_t(width) * height <= kWhole) return 0;
    return std::max(1, int(kBand / width / tile)) * tile;
}

void BandWriter::start(WrittenFrame frame, int height) {
    frame_ = std::move(frame);
    height_ = height;
    file_.reset();
}

bool BandWriter::take(const raytrace::Film& band) {
    if (frame_.file.empty()) return true;
    Stopwatch watch;
    if (band.top == 0) {
        file_.emplace();
        frame_.error =
            file_->begin(frame_.file, band, height_, frame_.color, frame_.texts, frame_.format);
    }
    if (frame_.error.empty()) frame_.error = file_->write(band);
    frame_.number = file_->number();
    frame_.ms += watch.ms();
    return frame_.error.empty();
}

WrittenFrame BandWriter::finish(bool whole, bool checksum) {
    Stopwatch watch;
    if (file_ && whole && frame_.error.empty()) {
        frame_.error = file_->end(checksum);
        frame_.number = file_->number();
    }
    file_.reset();
    frame_.ms += watch.ms();
    return std::exchange(frame_, {});
}

}  // namespace kinora
