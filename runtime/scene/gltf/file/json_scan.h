// runtime/scene/gltf/file/json_scan.h: positions in a JSON text, and its shape, before and without
// making values of it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/diagnostic.h"

namespace kinora {

struct JsonShape {
    size_t depth = 0;       // of nested arrays and objects
    size_t containers = 0;  // arrays and objects
};
// Looks at brackets outside strings only; the text need not be well-formed.
JsonShape json_shape(std::string_view text);

struct JsonRange {
    uint32_t begin = 0, end = 0;  // bytes
};

// Where the value that an RFC 6901 pointer ("/meshes/3/primitives") names stands, or the nearest
// value around it that is there. Nothing only if the text does not begin with a value. O(text).
std::optional<JsonRange> json_nearest(std::string_view text, std::string_view pointer);

// The value itself where it is there.
std::optional<JsonRange> json_find(std::string_view text, std::string_view pointer);

// The elements of the array that a pointer names; none where it is no array.
std::vector<JsonRange> json_elements(std::string_view text, std::string_view pointer);

// The number that a pointer names, or `otherwise`.
double json_number(std::string_view text, std::string_view pointer, double otherwise);

// The strings of an array of strings; other elements are skipped.
std::vector<std::string> json_strings(std::string_view text, std::string_view pointer);

// The text of the string at `range`, and where each of its bytes stands in the file that holds
// `text`.
std::string json_string(std::string_view text, JsonRange range, FileId file, SourceMap& map);

}  // namespace kinora
