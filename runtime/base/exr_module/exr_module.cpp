// runtime/base/exr_module/exr_module.cpp: EXR files through OpenEXR's C++ library.
#include "runtime/base/exr_module/exr_module.h"

#include "runtime/base/exr_module/exr_writer_p.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace {

// OpenEXR's own file stream closes without a word when the last bytes cannot be written; errors of
// this one stay in the FILE until its owner asks for them.
class ExrStream : public Imf::OStream {
  public:
    ExrStream(const char* path, std::FILE* file) : OStream(path), file_(file) {}
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

// Whether the call throws nothing; else what it throws, as a text.
template <class Call>
bool works(KinoraExrError& error, Call&& call) {
    errno = 0;
    error = {};
    try {
        call();
        return true;
    } catch (const std::exception& thrown) {
        error.number = errno;
        std::snprintf(error.text, sizeof error.text, "%s",
                      errno ? std::strerror(errno) : thrown.what());
        return false;
    }
}

size_t bytes_of(Imf::PixelType type) {
    return type == Imf::HALF ? sizeof(half) : sizeof(float);
}

}  // namespace

namespace {

// Frames through OpenEXR's own compressor.
class ZlibWriter final : public KinoraExrWriter {
  public:
    ZlibWriter(std::FILE* file, const char* path, const KinoraExrPicture& picture,
               std::vector<ExrChannel> channels)
        : stream_(path, file),
          width_(picture.width),
          half_(picture.half != 0),
          channels_(std::move(channels)),
          see_(picture.see),
          row_bytes_(picture, channels_) {
        Imf::Header header(width_, picture.height);
        header.compression() = Imf::ZIP_COMPRESSION;
        for (int i = 0; i < picture.texts; ++i)
            header.insert(picture.text[i].key, Imf::StringAttribute(picture.text[i].value));
        for (const ExrChannel& channel : channels_)
            header.channels().insert(channel.name, Imf::Channel(type_of(channel)));
        file_.emplace(stream_, header, 0);
    }

    // Frame buffers begin at the picture's first row.
    void write(int top, int rows, const float* rgba, const float* const* planes) override {
        if (half_) halves_.take(rgba, 4 * size_t(width_) * size_t(rows));
        Imf::FrameBuffer buffer;
        for (const ExrChannel& channel : channels_) {
            const bool plane = channel.plane >= 0;
            const size_t step = plane ? sizeof(float) : 4 * (half_ ? sizeof(half) : sizeof(float));
            const size_t row = step * size_t(width_);
            const void* first = plane   ? static_cast<const void*>(planes[channel.plane])
                                : half_ ? static_cast<const void*>(halves_.data() + channel.color)
                                        : static_cast<const void*>(rgba + channel.color);
            char* base = const_cast<char*>(static_cast<const char*>(first));
            buffer.insert(channel.name,
                          Imf::Slice(type_of(channel), base - row * size_t(top), step, row));
        }
        file_->setFrameBuffer(buffer);
        file_->writePixels(rows);
        for (size_t row = 0; see_.see && row < size_t(rows); ++row) {
            seen_.clear();
            row_bytes_.add(row, rgba, planes, seen_);
            see_.see(see_.state, seen_.data(), seen_.size());
        }
    }
    void end() override {
        file_.reset();  // whose destructor writes the table of lines
    }

  private:
    static Imf::PixelType type_of(const ExrChannel& channel) {
        return channel.half ? Imf::HALF : Imf::FLOAT;
    }

    ExrStream stream_;
    int width_;
    bool half_;
    std::vector<ExrChannel> channels_;
    Halves halves_;
    KinoraExrSee see_;
    RowBytes row_bytes_;
    std::vector<uint8_t> seen_;  // of a row
    std::optional<Imf::OutputFile> file_;
};

}  // namespace

std::vector<ExrChannel> exr_channels(const KinoraExrPicture& picture) {
    std::map<std::string, ExrChannel> by_name;
    auto add = [&](ExrChannel channel) { by_name[channel.name] = channel; };
    for (int k = 0; k < 4; ++k) add({std::string(1, "RGBA"[k]), picture.half != 0, k, -1});
    for (int i = 0; i < picture.planes; ++i) {
        std::string name = picture.plane_names[i];
        if (by_name.contains(name)) name += ".V";
        if (picture.plane_in_file[i]) add({name, false, 0, i});
    }
    std::vector<ExrChannel> channels;
    for (auto& [name, channel] : by_name) channels.push_back(std::move(channel));
    return channels;
}

extern "C" {

KinoraExrWriter* kinora_exr_begin(std::FILE* file, const char* path,
                                  const KinoraExrPicture* picture, KinoraExrError* error) {
    std::unique_ptr<KinoraExrWriter> writer;
    const bool good = works(*error, [&] {
        std::vector<ExrChannel> channels = exr_channels(*picture);
        if (picture->compressor.compress)
            writer = chunk_writer(file, path, *picture, std::move(channels));
        else
            writer = std::make_unique<ZlibWriter>(file, path, *picture, std::move(channels));
    });
    return good ? writer.release() : nullptr;
}

int kinora_exr_write(KinoraExrWriter* writer, int top, int rows, const float* rgba,
                     const float* const* planes, KinoraExrError* error) {
    return !works(*error, [&] { writer->write(top, rows, rgba, planes); });
}

int kinora_exr_end(KinoraExrWriter* writer, KinoraExrError* error) {
    const bool good = works(*error, [&] { writer->end(); });
    delete writer;
    return !good;
}

int64_t kinora_exr_text(const char* path, const char* key, char* value, uint64_t bytes) {
    KinoraExrError ignored;
    std::string found;
    bool any = false;
    works(ignored, [&] {
        Imf::RgbaInputFile file(path);
        if (!file.isComplete()) return;
        // A file cut short throws where its last rows should be.
        Imath::Box2i window = file.dataWindow();
        std::vector<Imf::Rgba> row(size_t(window.max.x - window.min.x) + 1);
        file.setFrameBuffer(row.data() - window.min.x, 1, 0);
        file.readPixels(window.max.y);
        const auto* text = file.header().findTypedAttribute<Imf::StringAttribute>(key);
        any = text != nullptr;
        if (text) found = text->value();
    });
    if (!any) return -1;
    std::snprintf(value, bytes, "%s", found.c_str());
    return int64_t(found.size());
}

int kinora_exr_see(const char* path, const KinoraExrSee* see) {
    KinoraExrError ignored;
    return !works(ignored, [&] {
        Imf::InputFile file(path);
        if (!file.isComplete()) throw std::runtime_error("rows are missing");
        const Imath::Box2i window = file.header().dataWindow();
        const size_t width = size_t(window.max.x - window.min.x) + 1;
        std::vector<std::pair<std::string, Imf::PixelType>> channels;
        size_t bytes = 0;
        for (auto at = file.header().channels().begin(); at != file.header().channels().end();
             ++at) {
            channels.emplace_back(at.name(), at.channel().type);
            bytes += width * bytes_of(at.channel().type);
        }
        std::vector<char> row(bytes);
        Imf::FrameBuffer buffer;
        char* channel_row = row.data();
        for (const auto& [name, type] : channels) {
            const size_t step = bytes_of(type);
            buffer.insert(name,
                          Imf::Slice(type, channel_row - ptrdiff_t(step) * window.min.x, step, 0));
            channel_row += step * width;
        }
        file.setFrameBuffer(buffer);
        for (int y = window.min.y; y <= window.max.y; ++y) {
            file.readPixels(y);
            see->see(see->state, row.data(), row.size());
        }
    });
}

int kinora_exr_read(const char* path, KinoraExrPixels* pixels) {
    KinoraExrError ignored;
    *pixels = {};
    const bool good = works(ignored, [&] {
        Imf::RgbaInputFile file(path);
        Imath::Box2i window = file.dataWindow();
        const int width = window.max.x - window.min.x + 1, height = window.max.y - window.min.y + 1;
        const size_t row_floats = 4 * size_t(width);
        auto* rgba = static_cast<float*>(std::malloc(row_floats * size_t(height) * sizeof(float)));
        if (!rgba) throw std::bad_alloc();
        *pixels = {width, height, rgba};
        std::vector<Imf::Rgba> row(row_floats / 4);
        for (int y = window.min.y; y <= window.max.y; ++y) {
            file.setFrameBuffer(row.data() - window.min.x, 1, 0);
            file.readPixels(y);
            for (const Imf::Rgba& p : row)
                for (float x : {float(p.r), float(p.g), float(p.b), float(p.a)}) *rgba++ = x;
        }
    });
    if (!good) kinora_exr_free_pixels(pixels);
    return !good;
}

void kinora_exr_free_pixels(KinoraExrPixels* pixels) {
    std::free(pixels->rgba);
    *pixels = {};
}
}
