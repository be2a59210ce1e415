// runtime/ri/display_files.h: a picture's displays as files.
#pragma once

#include "raytrace/film.h"
#include "runtime/base/diagnostic.h"
#include "runtime/scene/images/display_files.h"

namespace kinora::ri {

class DisplayFiles {
  public:
    explicit DisplayFiles(Diagnostics& diagnostics) : diagnostics_(diagnostics) {}

    // A file of each display, whatever its type, of which the film has the planes; without
    // displays "ri.png".
    void write(const FilePicture& picture, const raytrace::Film& film);

  private:
    void write_file(const DisplayFile& file, const FilePicture& picture,
                    const raytrace::Film& film);

    Diagnostics& diagnostics_;
    bool told_suffix_ = false;
};

}  // namespace kinora::ri
