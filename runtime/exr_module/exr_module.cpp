// runtime/exr_module/exr_module.cpp: EXR files through OpenEXR.
#include "runtime/exr_module/exr_module.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfRgbaFile.h>
#include <ImfStringAttribute.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
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

using kinora::in_range_of_halves;

constexpr const char* kColors[] = {"R", "G", "B", "A"};

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

}  // namespace

struct KinoraExrWriter {
    KinoraExrWriter(std::FILE* file, const char* path) : stream(path, file) {}

    void begin(const KinoraExrPicture& picture);
    void write(int top, int rows, const float* rgba, const float* const* planes);
    void end() {
        // Their destructors write the table of lines.
        colors.reset();
        all.reset();
    }

    ExrStream stream;
    int width = 0;
    bool half = false;
    std::optional<Imf::RgbaOutputFile> colors;  // halves without planes
    std::optional<Imf::OutputFile> all;
    std::vector<std::string> plane_channels;  // "": not in the file
    std::vector<Imf::Rgba> pixels;            // of halves

  private:
    void write_all(int top, int rows, const float* rgba, const float* const* planes);
};

void KinoraExrWriter::begin(const KinoraExrPicture& picture) {
    width = picture.width;
    half = picture.half != 0;
    Imf::Header header(width, picture.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (int i = 0; i < picture.texts; ++i)
        header.insert(picture.text[i].key, Imf::StringAttribute(picture.text[i].value));
    if (picture.planes == 0 && half) {
        colors.emplace(stream, header, Imf::WRITE_RGBA, 0);
        return;
    }
    Imf::ChannelList& channels = header.channels();
    for (const char* name : kColors)
        channels.insert(name, Imf::Channel(half ? Imf::HALF : Imf::FLOAT));
    for (int i = 0; i < picture.planes; ++i) {
        // A parameter that is called like a channel of the picture is R.V there.
        std::string name = picture.plane_names[i];
        if (channels.findChannel(name) != nullptr) name += ".V";
        if (picture.plane_in_file[i]) channels.insert(name, Imf::Channel(Imf::FLOAT));
        plane_channels.push_back(picture.plane_in_file[i] ? name : "");
    }
    all.emplace(stream, header, 0);
}

// Frame buffers begin at the picture's first row.
void KinoraExrWriter::write(int top, int rows, const float* rgba, const float* const* planes) {
    const size_t count = size_t(width) * size_t(rows);
    if (half) {
        pixels.resize(count);
        for (size_t i = 0; i < count; ++i, rgba += 4)
            pixels[i] = {in_range_of_halves(rgba[0]), in_range_of_halves(rgba[1]),
                         in_range_of_halves(rgba[2]), in_range_of_halves(rgba[3])};
        rgba -= 4 * count;
    }
    if (!colors) return write_all(top, rows, rgba, planes);
    colors->setFrameBuffer(pixels.data() - size_t(top) * size_t(width), 1, size_t(width));
    colors->writePixels(rows);
}

void KinoraExrWriter::write_all(int top, int rows, const float* rgba, const float* const* planes) {
    Imf::FrameBuffer buffer;
    auto add = [&](const std::string& name, Imf::PixelType type, const void* first, size_t step) {
        const size_t row = step * size_t(width);
        char* base = const_cast<char*>(static_cast<const char*>(first));
        buffer.insert(name, Imf::Slice(type, base - row * size_t(top), step, row));
    };
    for (size_t k = 0; k < 4; ++k)
        if (half)
            add(kColors[k], Imf::HALF, &pixels[0].r + k, sizeof(Imf::Rgba));
        else
            add(kColors[k], Imf::FLOAT, rgba + k, 4 * sizeof(float));
    for (size_t k = 0; k < plane_channels.size(); ++k)
        if (!plane_channels[k].empty())
            add(plane_channels[k], Imf::FLOAT, planes[k], sizeof(float));
    all->setFrameBuffer(buffer);
    all->writePixels(rows);
}

extern "C" {

KinoraExrWriter* kinora_exr_begin(std::FILE* file, const char* path,
                                  const KinoraExrPicture* picture, KinoraExrError* error) {
    std::unique_ptr<KinoraExrWriter> writer;
    const bool good = works(*error, [&] {
        writer = std::make_unique<KinoraExrWriter>(file, path);
        writer->begin(*picture);
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
