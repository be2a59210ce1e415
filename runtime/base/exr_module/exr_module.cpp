// runtime/base/exr_module/exr_module.cpp: EXR files through OpenEXR's C++ library.
#include "runtime/base/exr_module/exr_module.h"

#include "runtime/base/exr_module/exr_writer_p.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
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

std::vector<ExrChannel> exr_channels(const KinoraExrPicture& picture) {
    std::map<std::string, ExrChannel> by_name;
    auto add = [&](ExrChannel channel) { by_name[channel.name] = channel; };
    const std::string first = "rgba";  // the part with the colors
    for (int k = 0; k < 4; ++k) add({std::string(1, "RGBA"[k]), picture.half != 0, k, -1, first});
    for (int i = 0; i < picture.planes; ++i) {
        std::string name = picture.plane_names[i];
        if (by_name.contains(name)) name += ".V";
        const char* part = picture.plane_part ? picture.plane_part[i] : "rgba";
        if (picture.plane_in_file[i])
            add({name, picture.plane_half[i] != 0, 0, i, part, picture.plane_exact[i] != 0});
    }
    std::vector<ExrChannel> channels;
    for (auto& [name, channel] : by_name) channels.push_back(std::move(channel));
    return channels;
}

namespace {

// Rows of a part: one channel behind the other.
class RowReader {
  public:
    RowReader(Imf::MultiPartInputFile& file, int part) : part_(file, part) {
        const Imf::Header& header = part_.header();
        const Imath::Box2i window = header.dataWindow();
        const size_t width = size_t(window.max.x - window.min.x) + 1;
        size_t bytes = 0;
        for (auto at = header.channels().begin(); at != header.channels().end(); ++at)
            bytes += width * bytes_of(at.channel().type);
        row_.resize(bytes);
        Imf::FrameBuffer buffer;
        char* to = row_.data();
        for (auto at = header.channels().begin(); at != header.channels().end(); ++at) {
            const Imf::PixelType type = at.channel().type;
            const size_t step = bytes_of(type);
            buffer.insert(at.name(),
                          Imf::Slice(type, to - ptrdiff_t(step) * window.min.x, step, 0));
            to += step * width;
        }
        part_.setFrameBuffer(buffer);
    }
    const std::vector<char>& read(int y) {
        part_.readPixels(y);
        return row_;
    }

  private:
    Imf::InputPart part_;
    std::vector<char> row_;
};

}  // namespace

extern "C" {

KinoraExrWriter* kinora_exr_begin(std::FILE* file, const char* path,
                                  const KinoraExrPicture* picture, KinoraExrError* error) {
    std::unique_ptr<KinoraExrWriter> writer;
    const bool good = works(*error, [&] {
        std::vector<ExrChannel> channels = exr_channels(*picture);
        const bool by_chunks = picture->compressor.compress && !picture->plane_part &&
                               picture->compression == Imf::ZIP_COMPRESSION;
        writer = by_chunks ? chunk_writer(file, path, *picture, std::move(channels))
                           : library_writer(file, path, *picture, std::move(channels));
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
        Imf::MultiPartInputFile file(path);
        std::vector<RowReader> parts;
        for (int part = 0; part < file.parts(); ++part) {
            if (!file.partComplete(part)) throw std::runtime_error("rows are missing");
            parts.emplace_back(file, part);
        }
        const Imath::Box2i window = file.header(0).dataWindow();
        for (int y = window.min.y; y <= window.max.y; ++y)
            for (RowReader& part : parts) {
                const std::vector<char>& row = part.read(y);
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
