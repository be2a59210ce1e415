// tests/folders.h: where the project lies, and the data that scripts make for its tests.
#pragma once

#include <string>

namespace kinora {

// Absolute, without a slash at the end. One file alone knows them (tests/folders.cpp), so that all
// others compile to the same in every clone.
std::string project_folder();
std::string test_data_folder();

}  // namespace kinora
