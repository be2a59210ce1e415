// runtime/scene/gltf/file/value.cpp: members of the objects in extras and extensions.
#include "runtime/scene/gltf/file/value.h"

#include <cmath>

namespace kinora {

const tinygltf::Value* member(const tinygltf::Value& object, const char* name) {
    return object.IsObject() && object.Has(name) ? &object.Get(name) : nullptr;
}

std::optional<double> number_member(const tinygltf::Value& object, const char* name) {
    const tinygltf::Value* value = member(object, name);
    if (!value || !value->IsNumber() || !std::isfinite(value->GetNumberAsDouble()))
        return std::nullopt;
    return value->GetNumberAsDouble();
}

std::string string_member(const tinygltf::Value& object, const char* name) {
    const tinygltf::Value* value = member(object, name);
    return value && value->IsString() ? value->Get<std::string>() : "";
}

bool append_numbers(const tinygltf::Value& value, std::vector<double>& numbers) {
    if (value.IsNumber()) {
        numbers.push_back(value.GetNumberAsDouble());
        return true;
    }
    if (!value.IsArray()) return false;
    for (size_t i = 0; i < value.ArrayLen(); ++i)
        if (!append_numbers(value.Get(int(i)), numbers)) return false;
    return true;
}

std::vector<std::string> member_names(const tinygltf::Value& value) {
    return value.IsObject() ? value.Keys() : std::vector<std::string>();
}

}  // namespace kinora
