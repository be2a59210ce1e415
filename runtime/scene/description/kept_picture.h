// runtime/scene/description/kept_picture.h: pictures that a RIB file makes and looks up itself, as
// files in memory (memory_file.h).
#pragma once

#include <string>

#include "runtime/scene/description/file_picture.h"

namespace kinora {

// The name of one of the scene at `path`.
inline std::string kept_picture_name(const std::string& path, const MapPicture& picture) {
    return path + '#' + picture.display + '#' + std::to_string(picture.world);
}

}  // namespace kinora
