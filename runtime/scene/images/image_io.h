// runtime/scene/images/image_io.h: pictures to files and back. A file that has its final name is
// whole.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "raytrace/film.h"
#include "runtime/scene/images/exr_format.h"

namespace kinora {

enum class ColorEncoding : uint8_t { Linear, Srgb };

// The film as a file of that depth has it.
void round_to_depth(raytrace::Film& film, PictureDepth depth);

// Texts kept in the file's header: ("kinora/fingerprint", "...").
using ImageTexts = std::vector<std::pair<std::string, std::string>>;

// A text whose value the writer puts in: 16 digits of a hash of the pixels' bytes before they are
// compressed, row by row. In a PNG it stands behind the pixels. Where a compression loses some of
// them it is kLossyChecksum, and only whether all rows can be read is known.
inline constexpr const char* kChecksumText = "kinora/checksum";
inline constexpr size_t kChecksumDigits = 16;
inline constexpr const char* kLossyChecksum = "compressed lossy";

// 8-bit RGBA rows from the top, unassociated alpha.
struct Image8 {
    int width = 0, height = 0;
    std::vector<uint8_t> rgba;
};

// Film (linear, associated) to 8 bits: unassociated; sRGB-encoded (IEC 61966-2-1) or as is.
Image8 to_8_bit(const raytrace::Film& film, ColorEncoding encoding);

// Writes by the extension, .png (encoding as given) or .exr (in that format, linear,
// associated; the film's planes as channels): to a temporary name beside it, fsync,
// rename. The folder is there already. Returns an error text ("No space left on device"), or ""
// when done; errno_out (if given) gets the system's number.
std::string write_image(const std::string& path, const raytrace::Film& film, ColorEncoding encoding,
                        const ImageTexts& texts, int* errno_out = nullptr,
                        const ExrFormat& format = {});
std::string write_png(const std::string& path, const Image8& image, const ImageTexts& texts,
                      int* errno_out = nullptr);

// The same, in a folder that is made where it is missing.
std::string write_image_and_folder(const std::string& path, const raytrace::Film& film,
                                   ColorEncoding encoding, const ImageTexts& texts,
                                   int* errno_out = nullptr);

// Whether a file could be written there now, which a temporary one tries. Returns an error text, or
// "".
std::string try_image_path(const std::string& path, int* errno_out = nullptr);

// Whether write_image knows the extension.
bool is_image_path(const std::string& path);

// A text of a PNG or EXR header; nothing if the file is missing, broken or has no such text.
std::optional<std::string> read_image_text(const std::string& path, const std::string& key);

// Whether the whole file can be read and its pixels have the checksum that it carries. False where
// it carries none.
bool has_intact_pixels(const std::string& path);

// Nothing if it cannot be read.
std::optional<Image8> read_png(const std::string& path);
// A picture that write_image wrote, as to_8_bit gives it of the film (of an .exr: within the
// rounding of its halves).
std::optional<Image8> read_image(const std::string& path, ColorEncoding encoding);

}  // namespace kinora
