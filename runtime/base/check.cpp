// runtime/base/check.cpp: how a failed CHECK ends.
#include "runtime/base/check.h"

#include <cstdio>
#include <cstdlib>

namespace kinora {

void check_failed(const char* file, int line, const std::string& text) {
    std::fprintf(stderr, "%s:%d: CHECK failed: %s\n", file, line, text.c_str());
    std::abort();
}

}  // namespace kinora
