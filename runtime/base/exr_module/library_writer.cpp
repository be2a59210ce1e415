// runtime/base/exr_module/library_writer.cpp: EXR files through OpenEXR's C++ library, which knows
// all compressions and files of several parts.
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfIO.h>
#include <ImfMultiPartOutputFile.h>
#include <ImfOutputFile.h>
#include <ImfOutputPart.h>
#include <ImfPartType.h>
#include <ImfRational.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <ImfTimeCode.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <optional>
#include <stdexcept>
#include <utility>

#include "runtime/base/exr_module/exr_writer_p.h"

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

Imf::PixelType type_of(const ExrChannel& channel) {
    return channel.half ? Imf::HALF : Imf::FLOAT;
}

void insert_attribute(Imf::Header& header, const KinoraExrAttribute& attribute) {
    const double* n = attribute.numbers;
    auto f = [&](int i) { return float(n[i]); };
    switch (attribute.type) {
        case kKinoraExrRational:
            header.insert(attribute.key,
                          Imf::RationalAttribute(Imf::Rational(int(n[0]), unsigned(n[1]))));
            break;
        case kKinoraExrTimeCode:
            header.insert(attribute.key, Imf::TimeCodeAttribute(Imf::TimeCode(
                                             int(n[0]), int(n[1]), int(n[2]), int(n[3]))));
            break;
        case kKinoraExrMatrix:
            header.insert(attribute.key, Imf::M44fAttribute(Imath::M44f(
                                             f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7), f(8),
                                             f(9), f(10), f(11), f(12), f(13), f(14), f(15))));
            break;
        case kKinoraExrChromaticities:
            header.insert(attribute.key,
                          Imf::ChromaticitiesAttribute(Imf::Chromaticities(
                              {f(0), f(1)}, {f(2), f(3)}, {f(4), f(5)}, {f(6), f(7)})));
            break;
    }
}

Imf::Header header_of(const KinoraExrPicture& picture, const std::vector<ExrChannel>& channels) {
    Imf::Header header(picture.width, picture.height);
    const bool exact = std::ranges::all_of(channels, &ExrChannel::exact);
    header.compression() = exact ? Imf::ZIP_COMPRESSION : Imf::Compression(picture.compression);
    // DWA packs by zlib, too, whose level stays the usual one then.
    const bool by_zlib = header.compression() == Imf::ZIP_COMPRESSION ||
                         header.compression() == Imf::ZIPS_COMPRESSION;
    if (picture.level >= 0 && !exact && by_zlib) header.zipCompressionLevel() = int(picture.level);
    if (picture.level >= 0 && !exact && !by_zlib)
        header.dwaCompressionLevel() = float(picture.level);
    for (int i = 0; i < picture.attributes; ++i) insert_attribute(header, picture.attribute[i]);
    for (const ExrChannel& channel : channels)
        header.channels().insert(channel.name, Imf::Channel(type_of(channel)));
    return header;
}

// Channels of a part of the file, the first of which has the colors.
struct Part {
    std::string name;
    std::vector<ExrChannel> channels;
};

std::vector<Part> parts_of(std::vector<ExrChannel> channels) {
    std::vector<Part> parts{{"rgba", {}}};
    for (ExrChannel& channel : channels) {
        auto found = std::ranges::find(parts, channel.part, &Part::name);
        if (found == parts.end()) found = parts.insert(found, {channel.part, {}});
        found->channels.push_back(std::move(channel));
    }
    return parts;
}

class LibraryWriter final : public KinoraExrWriter {
  public:
    LibraryWriter(std::FILE* file, const char* path, const KinoraExrPicture& picture,
                  std::vector<ExrChannel> channels)
        : stream_(path, file),
          width_(picture.width),
          half_(picture.half != 0),
          parts_(parts_of(std::move(channels))),
          see_(picture.see) {
        std::vector<Imf::Header> headers;
        for (const Part& part : parts_) {
            headers.push_back(header_of(picture, part.channels));
            row_bytes_.emplace_back(picture, part.channels);
        }
        for (int i = 0; i < picture.texts; ++i)
            headers[0].insert(picture.text[i].key, Imf::StringAttribute(picture.text[i].value));
        if (parts_.size() == 1)
            file_.emplace(stream_, headers[0], 0);
        else
            open_parts(headers);
    }

    void write(int top, int rows, const float* rgba, const float* const* planes) override {
        if (half_) halves_.take(rgba, 4 * size_t(width_) * size_t(rows));
        for (size_t p = 0; p < parts_.size(); ++p) {
            const Imf::FrameBuffer buffer = buffer_of(parts_[p], top, rows, rgba, planes);
            if (file_)
                write_rows(*file_, buffer, rows);
            else
                write_rows(outputs_[p], buffer, rows);
        }
        for (size_t row = 0; see_.see && row < size_t(rows); ++row) {
            seen_.clear();
            for (RowBytes& bytes : row_bytes_) bytes.add(row, rgba, planes, seen_);
            see_.see(see_.state, seen_.data(), seen_.size());
        }
    }
    void end() override {
        file_.reset();  // whose destructor writes the table of lines
        outputs_.clear();
        several_.reset();
    }

  private:
    void open_parts(std::vector<Imf::Header>& headers) {
        for (size_t p = 0; p < parts_.size(); ++p) {
            headers[p].setName(parts_[p].name);
            headers[p].setType(Imf::SCANLINEIMAGE);
        }
        several_.emplace(stream_, headers.data(), int(headers.size()), false, 0);
        for (size_t p = 0; p < parts_.size(); ++p) outputs_.emplace_back(*several_, int(p));
    }

    template <class Output>
    static void write_rows(Output& output, const Imf::FrameBuffer& buffer, int rows) {
        output.setFrameBuffer(buffer);
        output.writePixels(rows);
    }

    // Frame buffers begin at the picture's first row. Halves of planes stay until the next part.
    Imf::FrameBuffer buffer_of(const Part& part, int top, int rows, const float* rgba,
                               const float* const* planes) {
        Imf::FrameBuffer buffer;
        plane_halves_.clear();
        for (const ExrChannel& channel : part.channels) {
            const bool plane = channel.plane >= 0;
            const size_t step = (plane ? 1 : 4) * (channel.half ? sizeof(half) : sizeof(float));
            const size_t row = step * size_t(width_);
            const void* first = nullptr;
            if (plane && channel.half) {
                Halves& halves = *plane_halves_.emplace_back(std::make_unique<Halves>());
                halves.take(planes[channel.plane], size_t(width_) * size_t(rows));
                first = halves.data();
            } else if (plane) {
                first = planes[channel.plane];
            } else {
                first = half_ ? static_cast<const void*>(halves_.data() + channel.color)
                              : static_cast<const void*>(rgba + channel.color);
            }
            char* base = const_cast<char*>(static_cast<const char*>(first));
            buffer.insert(channel.name,
                          Imf::Slice(type_of(channel), base - row * size_t(top), step, row));
        }
        return buffer;
    }

    ExrStream stream_;
    int width_;
    bool half_;
    std::vector<Part> parts_;
    Halves halves_;
    std::vector<std::unique_ptr<Halves>> plane_halves_;
    KinoraExrSee see_;
    std::vector<RowBytes> row_bytes_;      // by part
    std::vector<uint8_t> seen_;            // of a row
    std::optional<Imf::OutputFile> file_;  // of one part, else:
    std::optional<Imf::MultiPartOutputFile> several_;
    std::vector<Imf::OutputPart> outputs_;
};

}  // namespace

std::unique_ptr<KinoraExrWriter> library_writer(std::FILE* file, const char* path,
                                                const KinoraExrPicture& picture,
                                                std::vector<ExrChannel> channels) {
    return std::make_unique<LibraryWriter>(file, path, picture, std::move(channels));
}
