// runtime/scene/images/exr_format.h: how an EXR file holds a picture.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kinora {

// How an EXR has its colours: 2^-11 of a value, and 65504 at most, or as they were rendered.
enum class PictureDepth : uint8_t { Half, Float };

// A compression of OpenEXR.
struct ExrCompression {
    std::string_view name;
    int number;         // Imf::Compression
    bool lossy;         // of floats or of halves
    double most_level;  // 0: it has none
};
std::span<const ExrCompression> exr_compressions();

// What a header says of the camera and the time; numbers as KinoraExrAttribute has them.
enum class ExrValue : uint8_t { Rational, TimeCode, Matrix, Chromaticities };
struct ExrAttribute {
    std::string key;
    ExrValue type;
    std::array<double, 16> numbers{};
};

struct ExrFormat {
    ExrFormat(PictureDepth of = PictureDepth::Half) : depth(of) {}
    PictureDepth depth;
    const ExrCompression* compression = nullptr;  // null: zip
    double level = -1;                            // below 0: the usual one
    bool parts = false;  // a part for each layer, behind that of the colours; else one for all
    std::vector<ExrAttribute> attributes;

    bool lossy() const { return compression && compression->lossy; }
};

// NAME or NAME:LEVEL, into a format. False where there is no such compression or level.
bool parse_compression(std::string_view text, ExrFormat& format);

}  // namespace kinora
