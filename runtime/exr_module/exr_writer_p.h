// runtime/exr_module/exr_writer_p.h: what writes a picture, in one of two ways.
#pragma once

#include <half.h>

#include <memory>
#include <string>
#include <vector>

#include "runtime/exr_module/exr_module.h"

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

// Writes chunks that the picture's compressor made.
std::unique_ptr<KinoraExrWriter> chunk_writer(std::FILE* file, const char* path,
                                              const KinoraExrPicture& picture,
                                              std::vector<ExrChannel> channels);
