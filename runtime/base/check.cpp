// runtime/base/check.cpp: how a failed CHECK ends.
#include "runtime/base/check.h"

namespace kinora {

void check_failed(const char* file, int line, const std::string& text) {
    throw CheckFailed(std::string(file) + ":" + std::to_string(line) + ": CHECK failed: " + text);
}

}  // namespace kinora
