// runtime/ri/display_files.h: a picture's displays as files.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "raytrace/film.h"
#include "runtime/base/diagnostic.h"
#include "runtime/scene/description/file_picture.h"

namespace kinora::ri {

// "out.png" of "out.tif", "out.png" of "out"; .png and .exr stay.
std::string picture_file(const std::string& display);

class DisplayFiles {
  public:
    explicit DisplayFiles(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    // A file of each display of colours, whatever its type; without displays "ri.png".
    void write(const FilePicture& picture, const raytrace::Film& film);

  private:
    void write_file(const std::string& display, const raytrace::Film& film);
    bool once(const std::string& what) { return told_.insert(what).second; }

    Diagnostics& diagnostics_;
    std::set<std::string> told_;
};

}  // namespace kinora::ri
