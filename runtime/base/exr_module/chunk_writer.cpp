// runtime/base/exr_module/chunk_writer.cpp: EXR files through OpenEXRCore, which takes chunks that
// are compressed already. OpenEXR's C++ library knows no other compressor than zlib.
#include <openexr.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "runtime/base/exr_module/exr_writer_p.h"

namespace {

constexpr int kRowsOfChunk = 16;  // ZIP: openexr.com, "OpenEXR File Layout"
constexpr int kShortName = 31;    // longer ones are marked in the header

void must(exr_result_t result) {
    if (result != EXR_ERR_SUCCESS) throw std::runtime_error(exr_get_error_code_as_string(result));
}

// Errors are the codes that calls return.
void keep_quiet(exr_const_context_t, exr_result_t, const char*) {}

int64_t write_bytes(exr_const_context_t, void* user, const void* bytes, uint64_t count,
                    uint64_t offset, exr_stream_error_func_ptr_t) {
    auto* file = static_cast<std::FILE*>(user);
    if (std::ftell(file) != long(offset) && std::fseek(file, long(offset), SEEK_SET) != 0)
        return -1;
    return std::fwrite(bytes, 1, count, file) == count ? int64_t(count) : -1;
}

// What ZIP compresses: the even bytes, then the odd ones, and of each the difference to the one
// before, plus 128.
void predict(const std::vector<uint8_t>& raw, std::vector<uint8_t>& out) {
    const size_t count = raw.size(), evens = (count + 1) / 2;
    out.resize(count);
    if (count == 0) return;
    const uint8_t* from = raw.data();
    uint8_t* even = out.data();
    uint8_t* odd = out.data() + evens;
    even[0] = from[0];
    for (size_t k = 1; k < evens; ++k) even[k] = uint8_t(from[2 * k] - from[2 * k - 2] + 128);
    if (count > 1) odd[0] = uint8_t(from[1] - from[2 * evens - 2] + 128);
    for (size_t k = 1; k < count - evens; ++k)
        odd[k] = uint8_t(from[2 * k + 1] - from[2 * k - 1] + 128);
}

// SMPTE 12M, as OpenEXR's timeCode packs it: digits of frame, second, minute and hour, a byte each.
uint32_t time_code_bits(const double* hours_to_frame) {
    uint32_t bits = 0;
    for (int k = 0; k < 4; ++k) {
        const auto number = uint32_t(hours_to_frame[k]);
        bits = bits << 8 | number / 10 << 4 | number % 10;
    }
    return bits;
}

class ChunkWriter final : public KinoraExrWriter {
  public:
    ChunkWriter(std::FILE* file, const char* path, const KinoraExrPicture& picture,
                std::vector<ExrChannel> channels)
        : compressor_(picture.compressor),
          see_(picture.see),
          height_(picture.height),
          channels_(std::move(channels)),
          row_bytes_(picture, channels_) {
        exr_context_initializer_t setup = EXR_DEFAULT_CONTEXT_INITIALIZER;
        setup.error_handler_fn = keep_quiet;
        setup.user_data = file;
        setup.write_fn = write_bytes;
        must(exr_start_write(&context_, path, EXR_WRITE_FILE_DIRECTLY, &setup));
        try {
            write_header(picture);
        } catch (...) {
            exr_finish(&context_);
            throw;
        }
    }
    ChunkWriter(const ChunkWriter&) = delete;
    ~ChunkWriter() override {
        if (context_) exr_finish(&context_);
    }

    void write(int, int rows, const float* rgba, const float* const* planes) override {
        for (size_t row = 0; row < size_t(rows); ++row) {
            row_bytes_.add(row, rgba, planes, raw_);
            ++rows_;
            if (rows_ % kRowsOfChunk == 0 || rows_ == height_) write_chunk();
        }
    }

    void end() override { must(exr_finish(&context_)); }

  private:
    void write_header(const KinoraExrPicture& picture) {
        int part = 0;
        must(exr_add_part(context_, nullptr, EXR_STORAGE_SCANLINE, &part));
        bool long_names = false;
        auto look_at = [&](const char* name) { long_names |= std::strlen(name) > kShortName; };
        for (const ExrChannel& channel : channels_) look_at(channel.name.c_str());
        for (int i = 0; i < picture.texts; ++i) look_at(picture.text[i].key);
        if (long_names) must(exr_set_longname_support(context_, 1));
        must(exr_initialize_required_attr_simple(context_, part, picture.width, picture.height,
                                                 EXR_COMPRESSION_ZIP));
        for (const ExrChannel& channel : channels_)
            must(exr_add_channel(context_, part, channel.name.c_str(),
                                 channel.half ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT,
                                 EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
        for (int i = 0; i < picture.texts; ++i)
            must(exr_attr_set_string(context_, part, picture.text[i].key, picture.text[i].value));
        for (int i = 0; i < picture.attributes; ++i) set_attribute(part, picture.attribute[i]);
        must(exr_write_header(context_));
    }

    void set_attribute(int part, const KinoraExrAttribute& attribute) {
        const double* n = attribute.numbers;
        switch (attribute.type) {
            case kKinoraExrRational: {
                const exr_attr_rational_t value{int32_t(n[0]), uint32_t(n[1])};
                must(exr_attr_set_rational(context_, part, attribute.key, &value));
                break;
            }
            case kKinoraExrTimeCode: {
                const exr_attr_timecode_t value{time_code_bits(n), 0};
                must(exr_attr_set_timecode(context_, part, attribute.key, &value));
                break;
            }
            case kKinoraExrMatrix: {
                exr_attr_m44f_t value;
                std::copy_n(n, 16, value.m);
                must(exr_attr_set_m44f(context_, part, attribute.key, &value));
                break;
            }
            case kKinoraExrChromaticities: {
                float value[8];
                std::copy_n(n, 8, value);
                const exr_attr_chromaticities_t primaries{value[0], value[1], value[2], value[3],
                                                          value[4], value[5], value[6], value[7]};
                must(exr_attr_set_chromaticities(context_, part, attribute.key, &primaries));
                break;
            }
        }
    }

    void write_chunk() {
        if (see_.see) see_.see(see_.state, raw_.data(), raw_.size());
        predict(raw_, predicted_);
        packed_.resize(raw_.size());
        // What does not get smaller is in the file as it is.
        const size_t size =
            compressor_.compress(compressor_.state, predicted_.data(), predicted_.size(),
                                 packed_.data(), packed_.size() - 1);
        const int first = (rows_ - 1) / kRowsOfChunk * kRowsOfChunk;
        must(exr_write_scanline_chunk(context_, 0, first, size ? packed_.data() : raw_.data(),
                                      size ? size : raw_.size()));
        raw_.clear();
    }

    exr_context_t context_ = nullptr;
    KinoraExrCompressor compressor_;
    KinoraExrSee see_;
    int height_;
    std::vector<ExrChannel> channels_;
    RowBytes row_bytes_;
    std::vector<uint8_t> raw_, predicted_, packed_;  // of the chunk under way
    int rows_ = 0;                                   // taken so far
};

}  // namespace

std::unique_ptr<KinoraExrWriter> chunk_writer(std::FILE* file, const char* path,
                                              const KinoraExrPicture& picture,
                                              std::vector<ExrChannel> channels) {
    return std::make_unique<ChunkWriter>(file, path, picture, std::move(channels));
}
