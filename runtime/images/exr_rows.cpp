// runtime/images/exr_rows.cpp: rows of an EXR, by OpenEXR.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "runtime/base/regular_file.h"
#include "runtime/images/picture_rows_p.h"

namespace kinora {

namespace {

// OpenEXR's own file stream closes without a word when the last bytes cannot be written; errors of
// this one stay in the FILE until sync_file asks for them.
class ExrStream : public Imf::OStream {
  public:
    ExrStream(const std::string& path, std::FILE* file) : OStream(path.c_str()), file_(file) {}
    void write(const char bytes[], int count) override {
        if (std::fwrite(bytes, 1, size_t(count), file_) != size_t(count))
            throw std::runtime_error("write failed");
    }
    uint64_t tellp() override { return uint64_t(std::ftell(file_)); }
    void seekp(uint64_t position) override {
        if (std::fseek(file_, long(position), SEEK_SET) != 0)
            throw std::runtime_error("seek failed");
    }

  private:
    std::FILE* file_;
};

// What is finite stays finite: the largest half is 65504.
float to_half(float x) {
    return std::isfinite(x) ? std::clamp(x, -65504.0f, 65504.0f) : x;
}

// What a call of OpenEXR throws, as a text.
template <class Call>
std::string caught(int& number, Call&& call) {
    errno = 0;
    try {
        call();
        return "";
    } catch (const std::exception& error) {
        number = errno;
        return errno ? std::strerror(errno) : error.what();
    }
}

Imf::Rgba halves_of(const vec4& p) {
    return {to_half(p.x), to_half(p.y), to_half(p.z), to_half(p.w)};
}

constexpr const char* kColors[] = {"R", "G", "B", "A"};

// RGBA, and each plane of the film as a float channel of its name.
class ExrRowsToFile final : public RowWriter {
  public:
    ExrRowsToFile(const std::string& path, OpenFile file, PictureDepth depth)
        : file_(std::move(file)), stream_(path, file_.get()), depth_(depth) {}

    void begin(const raytrace::Film& film, int height, const ImageTexts& texts) {
        Imf::Header header(film.width, height);
        header.compression() = Imf::ZIP_COMPRESSION;
        for (const auto& [key, value] : texts) header.insert(key, Imf::StringAttribute(value));
        if (film.aovs.empty() && depth_ == PictureDepth::Half) {
            colors_.emplace(stream_, header, Imf::WRITE_RGBA, 0);
            return;
        }
        Imf::ChannelList& channels = header.channels();
        for (const char* name : kColors) channels.insert(name, Imf::Channel(color_type()));
        for (const raytrace::AovPlane& plane : film.aovs) {
            // A parameter that is called like a channel of the picture is R.V there.
            const bool taken = channels.findChannel(plane.name) != nullptr;
            plane_channels_.push_back(taken ? plane.name + ".V" : plane.name);
            if (plane.in_file) channels.insert(plane_channels_.back(), Imf::Channel(Imf::FLOAT));
        }
        all_.emplace(stream_, header, 0);
    }

    std::string write(const raytrace::Film& band, int& number) override {
        if (depth_ == PictureDepth::Half) {
            pixels_.resize(band.rgba.size());
            std::ranges::transform(band.rgba, pixels_.begin(), halves_of);
        }
        return caught(number, [&] { colors_ ? write_colors(band) : write_all(band); });
    }

    std::string end(int& number) override {
        // Their destructors write the table of lines.
        const std::string error = caught(number, [&] {
            colors_.reset();
            all_.reset();
        });
        return error.empty() ? sync_file(file_.get(), number) : error;
    }

  private:
    Imf::PixelType color_type() const {
        return depth_ == PictureDepth::Half ? Imf::HALF : Imf::FLOAT;
    }
    // Frame buffers begin at the picture's first row.
    void write_colors(const raytrace::Film& band) {
        const size_t width = size_t(band.width);
        colors_->setFrameBuffer(pixels_.data() - size_t(band.top) * width, 1, width);
        colors_->writePixels(band.height);
    }
    void write_all(const raytrace::Film& band) {
        Imf::FrameBuffer buffer;
        auto add = [&](const std::string& name, Imf::PixelType type, const void* first,
                       size_t step) {
            const size_t row = step * size_t(band.width);
            char* base = const_cast<char*>(static_cast<const char*>(first));
            buffer.insert(name, Imf::Slice(type, base - row * size_t(band.top), step, row));
        };
        for (size_t k = 0; k < 4; ++k)
            if (depth_ == PictureDepth::Half)
                add(kColors[k], Imf::HALF, &pixels_[0].r + k, sizeof(Imf::Rgba));
            else
                add(kColors[k], Imf::FLOAT, &band.rgba[0].x + k, sizeof(vec4));
        for (size_t k = 0; k < band.aovs.size(); ++k)
            if (band.aovs[k].in_file)
                add(plane_channels_[k], Imf::FLOAT, band.aovs[k].values.data(), sizeof(float));
        all_->setFrameBuffer(buffer);
        all_->writePixels(band.height);
    }

    OpenFile file_;
    ExrStream stream_;
    PictureDepth depth_;
    std::optional<Imf::RgbaOutputFile> colors_;  // halves without planes
    std::optional<Imf::OutputFile> all_;
    std::vector<std::string> plane_channels_;
    std::vector<Imf::Rgba> pixels_;  // of halves
};

}  // namespace

void round_to_depth(raytrace::Film& film, PictureDepth depth) {
    if (depth == PictureDepth::Float) return;
    for (vec4& p : film.rgba) {
        const Imf::Rgba h = halves_of(p);
        p = vec4(h.r, h.g, h.b, h.a);
    }
}

std::unique_ptr<RowWriter> exr_rows(const std::string& path, const raytrace::Film& film, int height,
                                    PictureDepth depth, const ImageTexts& texts,
                                    std::string& error, int& number) {
    errno = 0;
    OpenFile file(std::fopen(path.c_str(), "wb"));
    if (!file) {
        number = errno;
        error = std::strerror(errno);
        return nullptr;
    }
    auto rows = std::make_unique<ExrRowsToFile>(path, std::move(file), depth);
    error = caught(number, [&] { rows->begin(film, height, texts); });
    if (!error.empty()) rows.reset();
    return rows;
}

}  // namespace kinora
