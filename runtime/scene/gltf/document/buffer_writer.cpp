// runtime/scene/gltf/document/buffer_writer.cpp: the buffer of a glTF file, its views and
// accessors.
#include "runtime/scene/gltf/document/buffer_writer.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace kinora {

namespace {

template <class T>
constexpr int kComponentType = 0;
template <>
constexpr int kComponentType<float> = 5126;
template <>
constexpr int kComponentType<uint8_t> = 5121;
template <>
constexpr int kComponentType<uint16_t> = 5123;
template <>
constexpr int kComponentType<uint32_t> = 5125;

const char* type_name(uint32_t width) {
    static constexpr const char* kNames[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
    return width == 16 ? "MAT4" : kNames[width];
}

}  // namespace

uint32_t BufferWriter::view(const void* data, size_t size, int target) {
    bytes_.resize((bytes_.size() + 3) / 4 * 4, '\0');
    Json element = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", size}};
    if (target) element["target"] = target;
    bytes_.append(static_cast<const char*>(data), size);
    return document_.add("bufferViews", std::move(element));
}

// Accessors hold finite numbers only (glTF 2.0, 3.6.2.2).
void BufferWriter::mend(std::vector<float>& numbers) {
    for (float& x : numbers)
        if (!std::isfinite(x)) x = 0, ++unsound_;
}

template <class T>
uint32_t BufferWriter::accessor(std::vector<T> numbers, uint32_t width, int target, bool bounds) {
    if constexpr (std::is_same_v<T, float>) mend(numbers);
    uint32_t index = view(numbers.data(), numbers.size() * sizeof(T), target);
    Json result = {{"bufferView", index},
                   {"componentType", kComponentType<T>},
                   {"count", numbers.size() / width},
                   {"type", type_name(width)}};
    if (bounds) {
        Json low = Json::array(), high = Json::array();
        for (uint32_t c = 0; c < width; ++c) {
            T least = numbers[c], most = numbers[c];
            for (size_t i = c; i < numbers.size(); i += width) {
                least = std::min(least, numbers[i]);
                most = std::max(most, numbers[i]);
            }
            low.push_back(double(least));
            high.push_back(double(most));
        }
        result["min"] = low;
        result["max"] = high;
    }
    return document_.add("accessors", std::move(result));
}
template uint32_t BufferWriter::accessor(std::vector<float>, uint32_t, int, bool);
template uint32_t BufferWriter::accessor(std::vector<uint8_t>, uint32_t, int, bool);
template uint32_t BufferWriter::accessor(std::vector<uint16_t>, uint32_t, int, bool);
template uint32_t BufferWriter::accessor(std::vector<uint32_t>, uint32_t, int, bool);

}  // namespace kinora
