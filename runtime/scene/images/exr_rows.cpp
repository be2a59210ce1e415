// runtime/scene/images/exr_rows.cpp: rows of an EXR, by the module that links OpenEXR.
#define IMATH_HALF_NO_LOOKUP_TABLE  // which would be in its library
#include <half.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "runtime/base/files/content_hash.h"
#include "runtime/scene/images/exr_module_p.h"
#include "runtime/scene/images/libdeflate_p.h"
#include "runtime/scene/images/picture_rows_p.h"

namespace kinora {

namespace {

// Until the last row is known; as wide as the digits that take its place.
constexpr const char* kNoChecksum = "................";
static_assert(std::string_view(kNoChecksum).size() == kChecksumDigits);

void add_to_hash(void* hash, const void* bytes, size_t count) {
    static_cast<ContentHash*>(hash)->add(bytes, count);
}

// Over kNoChecksum in the header, which names of ids may make long. Where that is not found the
// file has no checksum.
void put_checksum(std::FILE* file, const std::string& digits) {
    std::string head;
    size_t at = head.npos;
    for (size_t most = 1 << 20; at == head.npos; most *= 4) {
        std::fseek(file, 0, SEEK_SET);
        head.resize(most);
        head.resize(std::fread(head.data(), 1, head.size(), file));
        const size_t name = head.find(std::string(kChecksumText) + '\0');
        at = name == head.npos ? name : head.find(kNoChecksum, name);
        if (head.size() < most) break;
    }
    std::fseek(file, at == head.npos ? 0 : long(at), at == head.npos ? SEEK_END : SEEK_SET);
    if (at != head.npos) std::fwrite(digits.data(), 1, digits.size(), file);
}

const ExrCompression& kUsual = *std::ranges::find(exr_compressions(), "zip", &ExrCompression::name);

std::vector<KinoraExrAttribute> attributes_of(const ExrFormat& format) {
    std::vector<KinoraExrAttribute> attributes;
    for (const ExrAttribute& from : format.attributes) {
        KinoraExrAttribute& to = attributes.emplace_back();
        to.key = from.key.c_str();
        to.type = KinoraExrType(from.type);
        std::ranges::copy(from.numbers, to.numbers);
    }
    return attributes;
}
static_assert(int(ExrValue::Chromaticities) == kKinoraExrChromaticities);

// The planes of a film as columns of KinoraExrPicture.
struct Planes {
    explicit Planes(const raytrace::Film& film) {
        for (const raytrace::AovPlane& plane : film.aovs) {
            names.push_back(plane.name.c_str());
            in_file.push_back(plane.in_file);
            half.push_back(plane.half);
            exact.push_back(plane.exact);
            parts.push_back(plane.layer.empty() ? plane.name.c_str() : plane.layer.c_str());
        }
    }
    std::vector<const char*> names, parts;
    std::vector<int> in_file, half, exact;
};

class ExrRowsToFile final : public RowWriter {
  public:
    explicit ExrRowsToFile(std::FILE* file) : file_(file) {}
    ~ExrRowsToFile() override {
        KinoraExrError ignored;
        if (writer_) exr_module().kinora_exr_end(writer_, &ignored);
        if (deflate_) libdeflate().libdeflate_free_compressor(deflate_);
    }

    std::string begin(const std::string& path, const raytrace::Film& film, int height,
                      const ExrFormat& format, const ImageTexts& texts, int& number) {
        std::vector<KinoraExrText> header;
        for (const auto& [key, value] : texts) {
            const bool checksum = key == kChecksumText;
            wants_checksum_ |= checksum && !format.lossy();
            const char* held = format.lossy() ? kLossyChecksum : kNoChecksum;
            header.push_back({key.c_str(), checksum ? held : value.c_str()});
        }
        const std::vector<KinoraExrAttribute> attributes = attributes_of(format);
        const Planes planes(film);
        const KinoraExrPicture picture{
            .width = film.width,
            .height = height,
            .half = format.depth == PictureDepth::Half,
            .planes = int(planes.names.size()),
            .plane_names = planes.names.data(),
            .plane_in_file = planes.in_file.data(),
            .plane_half = planes.half.data(),
            .plane_exact = planes.exact.data(),
            .plane_part = format.parts ? planes.parts.data() : nullptr,
            .compression = (format.compression ? *format.compression : kUsual).number,
            .level = format.level,
            .attributes = int(attributes.size()),
            .attribute = attributes.data(),
            .texts = int(header.size()),
            .text = header.data(),
            .compressor = compressor(format.level),
            .see = {&hash_, wants_checksum_ ? add_to_hash : nullptr}};
        KinoraExrError error{};
        writer_ = exr_module().kinora_exr_begin(file_, path.c_str(), &picture, &error);
        return told(writer_ == nullptr, error, number);
    }

    std::string write(const raytrace::Film& band, int& number) override {
        std::vector<const float*> planes;
        for (const raytrace::AovPlane& plane : band.aovs) planes.push_back(plane.values.data());
        KinoraExrError error{};
        const int failed = exr_module().kinora_exr_write(writer_, band.top, band.height,
                                                         &band.rgba[0].x, planes.data(), &error);
        return told(failed, error, number);
    }

    std::string end(bool checksum, int& number) override {
        KinoraExrError error{};
        const int failed = exr_module().kinora_exr_end(std::exchange(writer_, nullptr), &error);
        if (!failed && checksum && wants_checksum_) put_checksum(file_, hash_.digits());
        return told(failed, error, number);
    }

  private:
    static std::string told(bool failed, const KinoraExrError& error, int& number) {
        if (failed) number = error.number;
        return failed ? error.text : "";
    }

    // libdeflate's where it is there: half of zlib's time.
    KinoraExrCompressor compressor(double level) {
        constexpr int kLevel = 4;  // the size of zlib's level 4, which OpenEXR takes
        if (!libdeflate().error().empty()) return {};
        deflate_ = libdeflate().libdeflate_alloc_compressor(level < 0 ? kLevel : int(level));
        if (!deflate_) return {};
        return {deflate_, [](void* state, const void* in, size_t count, void* out, size_t room) {
                    return libdeflate().libdeflate_zlib_compress(
                        static_cast<libdeflate_compressor*>(state), in, count, out, room);
                }};
    }

    std::FILE* file_;
    KinoraExrWriter* writer_ = nullptr;
    libdeflate_compressor* deflate_ = nullptr;
    bool wants_checksum_ = false;
    ContentHash hash_;
};

}  // namespace

void round_to_depth(raytrace::Film& film, PictureDepth depth) {
    if (depth == PictureDepth::Float) return;
    for (vec4& p : film.rgba)
        for (int k = 0; k < 4; ++k) p[k] = Imath::half(in_range_of_halves(p[k]));
}

std::unique_ptr<RowWriter> exr_rows(std::FILE* file, const std::string& path,
                                    const raytrace::Film& film, int height, const ExrFormat& format,
                                    const ImageTexts& texts, std::string& error, int& number) {
    error = exr_module().error();
    if (!error.empty()) return nullptr;
    auto rows = std::make_unique<ExrRowsToFile>(file);
    error = rows->begin(path, film, height, format, texts, number);
    if (!error.empty()) rows.reset();
    return rows;
}

}  // namespace kinora
