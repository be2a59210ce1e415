// tests/shared.h: the folder of scenes and documents beside the repository. Tests that need it skip
// where it is missing; KINORA_SHARED names another place, or none.
#pragma once

#include <cstdlib>
#include <filesystem>

#include "tests/folders.h"

inline std::filesystem::path shared_folder() {
    const char* named = std::getenv("KINORA_SHARED");
    return named ? named : kinora::project_folder() + "/../shared";
}
inline std::filesystem::path shared_scenes() {
    return shared_folder() / "scenes";
}
