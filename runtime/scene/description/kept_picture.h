// runtime/scene/description/kept_picture.h: pictures that a RIB file makes and looks up itself, as
// files in memory (memory_file.h).
#pragma once

#include <string>

namespace kinora {

// The name of what a display of the scene at `path` shows.
inline std::string kept_picture_name(const std::string& path, const std::string& display) {
    return path + '#' + display;
}

}  // namespace kinora
