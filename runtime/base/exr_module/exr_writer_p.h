// runtime/base/exr_module/exr_writer_p.h: what writes a picture, in one of two ways.
#pragma once

#include <half.h>

#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "runtime/base/exr_module/exr_module.h"

// Errors are thrown as std::exception; errno is the system's.
struct KinoraExrWriter {
    virtual ~KinoraExrWriter() = default;
    virtual void write(int top, int rows, const float* rgba, const float* const* planes) = 0;
    virtual void end() = 0;
};

// A channel of the file.
struct ExrChannel {
    std::string name;
    bool half;  // else floats
    int color;  // 0 to 3 of RGBA, where `plane` is -1
    int plane;
    std::string part;  // of the file
    bool exact = false;
};

// In the order of the file, which is that of their names. A parameter that is called like a channel
// of the picture is R.V there.
std::vector<ExrChannel> exr_channels(const KinoraExrPicture& picture);

// Colors as the file has them.
class Halves {
  public:
    void take(const float* rgba, size_t count) {
        halves_.resize(count);
        for (size_t i = 0; i < count; ++i) halves_[i] = kinora::in_range_of_halves(rgba[i]);
    }
    const half* data() const { return halves_.data(); }

  private:
    std::vector<half> halves_;
};

// Rows as the file has them: of each row one channel behind the other.
class RowBytes {
  public:
    RowBytes(const KinoraExrPicture& picture, const std::vector<ExrChannel>& channels)
        : width_(size_t(picture.width)), half_(picture.half != 0), channels_(channels) {}

    // Adds row `row` of the numbers given to `bytes`.
    void add(size_t row, const float* rgba, const float* const* planes,
             std::vector<uint8_t>& bytes) {
        if (half_) halves_.take(rgba + 4 * row * width_, 4 * width_);
        for (const ExrChannel& channel : channels_) {
            if (channel.plane >= 0 && channel.half) {
                plane_halves_.take(planes[channel.plane] + row * width_, width_);
                add_numbers(plane_halves_.data(), 1, bytes);
            } else if (channel.plane >= 0)
                add_numbers(planes[channel.plane] + row * width_, 1, bytes);
            else if (half_)
                add_numbers(halves_.data() + channel.color, 4, bytes);
            else
                add_numbers(rgba + 4 * row * width_ + channel.color, 4, bytes);
        }
    }

  private:
    // Every `step`th number. The file has the bytes of x86-64 and AArch64.
    template <class T>
    void add_numbers(const T* from, size_t step, std::vector<uint8_t>& bytes) const {
        const size_t before = bytes.size();
        bytes.resize(before + width_ * sizeof(T));
        uint8_t* to = bytes.data() + before;
        for (size_t x = 0; x < width_; ++x, to += sizeof(T))
            std::memcpy(to, &from[x * step], sizeof(T));
    }

    size_t width_;
    bool half_;
    std::vector<ExrChannel> channels_;
    Halves halves_, plane_halves_;  // of a row
};

// Writes by OpenEXR's own means, whatever the picture's compression and parts.
std::unique_ptr<KinoraExrWriter> library_writer(std::FILE* file, const char* path,
                                                const KinoraExrPicture& picture,
                                                std::vector<ExrChannel> channels);
// Writes chunks that the picture's compressor made.
std::unique_ptr<KinoraExrWriter> chunk_writer(std::FILE* file, const char* path,
                                              const KinoraExrPicture& picture,
                                              std::vector<ExrChannel> channels);
