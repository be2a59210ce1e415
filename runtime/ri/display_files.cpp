// runtime/ri/display_files.cpp: displays by name and mode.
#include "runtime/ri/display_files.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "runtime/scene/description/findings.h"

namespace kinora::ri {

void DisplayFiles::write_file(const DisplayFile& file, const FilePicture& picture,
                              const raytrace::Film& film) {
    const std::string& name = file.display.name;
    if (file.path != name && !name.empty() && !std::exchange(told_suffix_, true))
        diagnostics_.report(Code::RI_DISPLAY, file.display.where, name, file.path);
    std::string error = write_display(file, picture.exposure, film, ColorEncoding::Linear, {});
    if (!error.empty())
        diagnostics_.report(Code::RI_NOT_WRITTEN, file.display.where, file.path, error);
}

// What is missing was a finding when the scene was built.
void DisplayFiles::write(const FilePicture& picture, const raytrace::Film& film) {
    auto is_there = [&](const std::string& output) {
        return std::ranges::any_of(film.aovs, [&](const raytrace::AovPlane& plane) {
            return plane.name.substr(0, plane.name.find('.')) == output;
        });
    };
    std::vector<FileDisplay> displays = picture.displays;
    if (displays.empty()) displays.emplace_back();
    for (const DisplayFile& file : display_files(displays))
        if (has_outputs(file.display, is_there)) write_file(file, picture, film);
}

}  // namespace kinora::ri
