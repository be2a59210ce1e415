// runtime/base/files/build_id.h: which build of a program this is.
#pragma once

#include <string>

namespace kinora {

// The hexadecimal digits that the linker gave the running program, which are the same for the same
// code; a hash of its file where it gave none.
std::string build_id();

}  // namespace kinora
