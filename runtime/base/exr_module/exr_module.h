// runtime/base/exr_module/exr_module.h: the C interface of libkinora_exr.so, which alone links
// OpenEXR and is opened when a picture is first written or read as EXR.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>

extern "C" {

struct KinoraExrError {
    int number;      // the system's, 0 where it says nothing
    char text[256];  // what failed
};

struct KinoraExrText {
    const char *key, *value;
};

// What makes zlib's format faster than zlib. Its result depends on `in` alone: the bytes written to
// `out`, 0 where they are more than `room`.
struct KinoraExrCompressor {
    void* state;  // the caller's, given back
    size_t (*compress)(void* state, const void* in, size_t count, void* out, size_t room);
};

// Sees the bytes of rows as they are before they are compressed: of each row one channel behind the
// other, in the order of the file.
struct KinoraExrSee {
    void* state;                                                // the caller's, given back
    void (*see)(void* state, const void* bytes, size_t count);  // null: nobody does
};

enum KinoraExrType {
    kKinoraExrRational,       // a numerator and a denominator
    kKinoraExrTimeCode,       // hours, minutes, seconds, frame
    kKinoraExrMatrix,         // 16 numbers of a matrix behind row vectors, row by row
    kKinoraExrChromaticities  // x and y of red, green, blue and white
};

// What a header says in numbers.
struct KinoraExrAttribute {
    const char* key;
    enum KinoraExrType type;
    double numbers[16];
};

// RGBA by halves or floats, and planes as channels; linear, associated.
struct KinoraExrPicture {
    int width, height;
    int half;  // RGBA are halves
    int planes;
    const char* const* plane_names;  // with `planes` members: ...
    const int* plane_in_file;        // ... 0: only its name is taken
    const int* plane_half;           // ... not 0: halves
    const int* plane_exact;          // ... not 0: with ZIP, if the part is its own
    const char* const* plane_part;   // ... the part of the file; null: all are in one
    int compression;                 // Imf::Compression
    double level;                    // of ZIP and DWA; below 0: the usual one
    int attributes;
    const KinoraExrAttribute* attribute;
    int texts;
    const KinoraExrText* text;
    KinoraExrCompressor compressor;  // of ZIP in one part; stays while the picture is written;
                                     // none: OpenEXR's zlib
    KinoraExrSee see;
};

// Rows from the top.
struct KinoraExrPixels {
    int width, height;
    float* rgba;  // free with kinora_exr_free_pixels
};

struct KinoraExrWriter;

// A picture that is written to `file`, which stays the caller's and is named in errors by `path`.
// Null with `error`.
KinoraExrWriter* kinora_exr_begin(std::FILE* file, const char* path,
                                  const KinoraExrPicture* picture, KinoraExrError* error);
// The next rows, which begin with row `top` of the picture: 4 floats a pixel, and a row of
// `planes`' numbers for each that is in the file. 0, or another number with `error`.
int kinora_exr_write(KinoraExrWriter* writer, int top, int rows, const float* rgba,
                     const float* const* planes, KinoraExrError* error);
// Writes the table of lines where all rows were written, and frees the writer in any case.
int kinora_exr_end(KinoraExrWriter* writer, KinoraExrError* error);

// A text of a whole file's header into `value`, up to `bytes` with the final 0. Returns its length,
// -1 where the file or the text is not there.
int64_t kinora_exr_text(const char* path, const char* key, char* value, uint64_t bytes);

// Shows all rows of a whole file; 0, or another number where they cannot be read.
int kinora_exr_see(const char* path, const KinoraExrSee* see);

// RGBA of a file; 0, or another number where it cannot be read.
int kinora_exr_read(const char* path, KinoraExrPixels* pixels);
void kinora_exr_free_pixels(KinoraExrPixels* pixels);
}

namespace kinora {

// What is finite stays finite: the largest half is 65504.
inline float in_range_of_halves(float x) {
    return std::isfinite(x) ? std::clamp(x, -65504.0f, 65504.0f) : x;
}

}  // namespace kinora
