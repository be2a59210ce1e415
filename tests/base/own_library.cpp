// tests/base/own_library.cpp: the base inside a shared library, as other programs may load it.
#include <string>

#include "runtime/base/shared_library.h"

extern "C" const char* kinora_test_module_path() {
    static const std::string path = kinora::module_path("libx.so");
    return path.c_str();
}
