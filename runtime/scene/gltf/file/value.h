// runtime/scene/gltf/file/value.h: members of the objects in extras and extensions, whatever they
// hold.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/scene/gltf/file/file.h"

namespace kinora {

// Null where `object` is no object or has no such member.
const tinygltf::Value* member(const tinygltf::Value& object, const char* name);

// A finite number; nothing where there is none.
std::optional<double> number_member(const tinygltf::Value& object, const char* name);

// A string; "" where there is none.
std::string string_member(const tinygltf::Value& object, const char* name);

// Appends the numbers of a number, an array of numbers, or arrays within it; false at the first
// value that is neither.
bool append_numbers(const tinygltf::Value& value, std::vector<double>& numbers);

// The names of an object's members; none where it is no object.
std::vector<std::string> member_names(const tinygltf::Value& value);

}  // namespace kinora
