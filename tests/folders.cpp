// tests/folders.cpp: the folders that CMake names.
#include "tests/folders.h"

namespace kinora {

std::string project_folder() {
    return KINORA_SOURCE_DIR;
}

std::string test_data_folder() {
    return KINORA_TEST_DATA;
}

}  // namespace kinora
