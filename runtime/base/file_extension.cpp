// runtime/base/file_extension.cpp: the ends of files' names.
#include "runtime/base/file_extension.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace kinora {

std::string lower_extension(std::string_view path) {
    std::string text = std::filesystem::path(path).extension().string();
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

bool has_extension(std::string_view path, std::initializer_list<std::string_view> extensions) {
    return std::ranges::find(extensions, lower_extension(path)) != extensions.end();
}

}  // namespace kinora
