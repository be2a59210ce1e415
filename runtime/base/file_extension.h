// runtime/base/file_extension.h: what kind of file a name promises, whatever its letter case.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace kinora {

// ".png" of "a/B.PNG"; "" where there is none.
std::string lower_extension(std::string_view path);

// The extension is one of these, which are in small letters.
bool has_extension(std::string_view path, std::initializer_list<std::string_view> extensions);

}  // namespace kinora
