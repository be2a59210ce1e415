// runtime/scene/images/display_files.h: the displays of a scene file as files of ours.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "runtime/base/parallel.h"
#include "runtime/scene/description/file_picture.h"
#include "runtime/scene/images/image_io.h"

namespace kinora {

// A display and the file that it becomes: .png where its numbers become whole ones of 8 bits, .exr
// where they stay floats.
struct DisplayFile {
    FileDisplay display;
    std::string path;
};

// "out.png" of "out.tif", "out.exr" of "out.tif" with floats; other suffixes stay before ours.
std::string file_of(const FileDisplay& display);

// The files of displays, by their own names. One that shows the colours of another on a screen, or
// into its file, is left out. Where several would have one file, the later has its mode in its
// name.
std::vector<DisplayFile> display_files(std::span<const FileDisplay> displays);
// The last part of a display's name without the suffix of a picture.
std::string display_stem(const FileDisplay& display);
// Displays that have the number of their frame behind their stem.
struct NumberedDisplays {
    std::string number;           // "0007"; "": none has
    std::set<std::string> stems;  // of these
};
// Those besides the first display of colours, which is the file `picture` whatever its own name is.
// They lie in its folder, by their stems.
std::vector<DisplayFile> displays_beside(const std::string& picture,
                                         std::span<const FileDisplay> displays,
                                         const NumberedDisplays& numbered = {});

// Whether what the display shows is there, by the names of outputs that are: "z", "N".
bool has_outputs(const FileDisplay& display, FunctionRef<bool(const std::string&)> is_there);

// Writes what a film shows that was exposed so, as write_image() does. The encoding is of colours
// that have no quantization but the usual one. Returns an error text, or "".
std::string write_display(const DisplayFile& file, const Exposure& exposed,
                          const raytrace::Film& film, ColorEncoding encoding,
                          const ImageTexts& texts, int* errno_out = nullptr);

}  // namespace kinora
