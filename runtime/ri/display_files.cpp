// runtime/ri/display_files.cpp: displays by name and mode.
#include "runtime/ri/display_files.h"

#include <fmt/format.h>

#include "runtime/base/file_extension.h"
#include "runtime/scene/description/findings.h"
#include "runtime/scene/images/image_io.h"

namespace kinora::ri {
namespace {

constexpr const char* kUnnamed = "ri.png";

bool has_colors(const FileDisplay& display) {
    return display.mode.starts_with("rgb");
}

}  // namespace

std::string picture_file(const std::string& display) {
    if (is_image_path(display)) return display;
    const bool other = has_extension(
        display, {".tif", ".tiff", ".jpg", ".jpeg", ".gif", ".bmp", ".tga", ".rgb", ".sgi", ".pic",
                  ".pix", ".rla",  ".iff", ".ppm",  ".pnm", ".cin", ".dpx", ".hdr", ".it",  ".tx"});
    return (other ? display.substr(0, display.rfind('.')) : display) + ".png";
}

void DisplayFiles::write_file(const std::string& display, const raytrace::Film& film) {
    std::string file = display.empty() ? kUnnamed : picture_file(display);
    if (file != display && !display.empty() && once("file"))
        diagnostics_.report(Code::RI_DISPLAY, Location{}, display, file);
    std::string error = write_image_and_folder(file, film, ColorEncoding::Linear, {});
    if (!error.empty()) diagnostics_.report(Code::RI_NOT_WRITTEN, Location{}, file, error);
}

void DisplayFiles::write(const FilePicture& picture, const raytrace::Film& film) {
    std::set<std::string> names;  // a display often stands beside another one of its name
    for (const FileDisplay& display : picture.displays) {
        if (display.mode != "rgb" && display.mode != "rgba" && once(display.mode))
            diagnostics_.report(Code::RI_NOT_DONE, Location{}, "Display",
                                fmt::format("of '{}' colours alone are written", display.mode));
        if (has_colors(display)) names.insert(display.name);
    }
    if (picture.displays.empty()) names.insert("");
    for (const std::string& name : names) write_file(name, film);
}

}  // namespace kinora::ri
