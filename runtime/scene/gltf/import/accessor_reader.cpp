// runtime/scene/gltf/import/accessor_reader.cpp: the numbers of accessors, every byte checked.
#include "runtime/scene/gltf/import/accessor_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "runtime/scene/description/findings.h"

namespace kinora {

namespace {

template <class T>
T load(const uint8_t* at) {
    T value;
    std::memcpy(&value, at, sizeof value);
    return value;
}

// Integers as they are, or as fractions of their largest (glTF 2.0, 3.6.2.2 and 3.11).
template <class T>
double number(const uint8_t* at, bool normalized) {
    double value = double(load<T>(at));
    if constexpr (std::is_integral_v<T>)
        if (normalized) return std::max(value / double(std::numeric_limits<T>::max()), -1.0);
    return value;
}

struct ComponentRow {
    int type;
    uint32_t bytes;
    bool index;  // may hold indices
    double (*number)(const uint8_t*, bool normalized);
};
constexpr ComponentRow kComponents[] = {
    {TINYGLTF_COMPONENT_TYPE_BYTE, 1, false, number<int8_t>},
    {TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE, 1, true, number<uint8_t>},
    {TINYGLTF_COMPONENT_TYPE_SHORT, 2, false, number<int16_t>},
    {TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT, 2, true, number<uint16_t>},
    {TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT, 4, true, number<uint32_t>},
    {TINYGLTF_COMPONENT_TYPE_FLOAT, 4, false, number<float>},
};

const ComponentRow* find_component(int type) {
    for (const ComponentRow& row : kComponents)
        if (row.type == type) return &row;
    return nullptr;
}

struct WidthRow {
    int type;
    uint32_t width;
};
constexpr WidthRow kWidths[] = {{TINYGLTF_TYPE_SCALAR, 1},
                                {TINYGLTF_TYPE_VEC2, 2},
                                {TINYGLTF_TYPE_VEC3, 3},
                                {TINYGLTF_TYPE_VEC4, 4},
                                {TINYGLTF_TYPE_MAT4, 16}};

uint32_t width_of(int type) {
    for (const WidthRow& row : kWidths)
        if (row.type == type) return row.width;
    return 0;
}

// Whether `count` elements of `bytes` lie within `size`, `stride` apart from `offset` on.
bool fits(size_t size, size_t offset, size_t stride, size_t bytes, size_t count) {
    if (count == 0) return true;
    if (offset > size || bytes > size - offset) return false;
    return stride == 0 || (count - 1) <= (size - offset - bytes) / stride;
}

}  // namespace

// The bytes of a buffer view; null data where it is not sound.
AccessorReader::View AccessorReader::view_bytes(int view, int accessor) {
    if (!has_index(view, model_.bufferViews.size())) return {};
    const tinygltf::BufferView& from = model_.bufferViews[size_t(view)];
    std::string own = fmt::format("/bufferViews/{}", view);
    if (!has_index(from.buffer, model_.buffers.size())) return {};
    const std::vector<unsigned char>& data = model_.buffers[size_t(from.buffer)].data;
    if (from.byteOffset > data.size() || from.byteLength > data.size() - from.byteOffset) {
        report_.add(
            Code::GLTF_ACCESSOR, own, accessor,
            fmt::format("its buffer view {} reaches past the end of buffer {}", view, from.buffer));
        return {};
    }
    return {data.data() + from.byteOffset, from.byteLength, from.byteStride};
}

bool AccessorReader::read(int accessor, AccessorNumbers& out) {
    out = {};
    if (!has_index(accessor, model_.accessors.size())) return false;
    const tinygltf::Accessor& from = model_.accessors[size_t(accessor)];
    std::string own = fmt::format("/accessors/{}", accessor);
    auto refuse = [&](const std::string& why) {
        report_.add(Code::GLTF_ACCESSOR, own, accessor, why);
        return false;
    };
    const ComponentRow* component = find_component(from.componentType);
    out.width = width_of(from.type);
    if (!component || out.width == 0) return refuse("its type is not one that anything here has");
    if (from.count == 0) return refuse("it has no elements");
    size_t bytes = component->bytes * out.width;
    View view;
    if (from.bufferView >= 0) {
        view = view_bytes(from.bufferView, accessor);
        if (!view.data) return false;
        if (view.stride == 0) view.stride = bytes;
        if (!fits(view.size, from.byteOffset, view.stride, bytes, from.count))
            return refuse("it reaches past the end of its buffer view");
    }
    if (from.count > SIZE_MAX / 64 || !budget_.charge(from.count * out.width * sizeof(float), own))
        return refuse("it has too many elements");
    out.values.assign(from.count * out.width, 0.0f);
    if (view.data)
        for (size_t i = 0; i < from.count; ++i)
            for (uint32_t k = 0; k < out.width; ++k)
                out.values[i * out.width + k] = float(component->number(
                    view.data + from.byteOffset + i * view.stride + k * component->bytes,
                    from.normalized));
    return !from.sparse.isSparse || read_sparse(accessor, out);
}

// Elements that stand apart (glTF 2.0, 3.6.2.3).
bool AccessorReader::read_sparse(int accessor, AccessorNumbers& out) {
    const tinygltf::Accessor& from = model_.accessors[size_t(accessor)];
    const auto& sparse = from.sparse;
    std::string own = fmt::format("/accessors/{}/sparse", accessor);
    auto refuse = [&](const std::string& why) {
        report_.add(Code::GLTF_ACCESSOR, own, accessor, why);
        return false;
    };
    const ComponentRow* index = find_component(sparse.indices.componentType);
    const ComponentRow* component = find_component(from.componentType);
    if (!index || !index->index) return refuse("its sparse indices are not unsigned integers");
    if (sparse.count < 0 || sparse.indices.byteOffset < 0 || sparse.values.byteOffset < 0)
        return refuse("its sparse part has negative numbers");
    View indices = view_bytes(sparse.indices.bufferView, accessor);
    View values = view_bytes(sparse.values.bufferView, accessor);
    if (!indices.data || !values.data) return false;
    size_t count = size_t(sparse.count), bytes = component->bytes * out.width;
    size_t first_index = size_t(sparse.indices.byteOffset);
    size_t first_value = size_t(sparse.values.byteOffset);
    if (!fits(indices.size, first_index, index->bytes, index->bytes, count) ||
        !fits(values.size, first_value, bytes, bytes, count))
        return refuse("its sparse part reaches past the end of its buffer view");
    for (size_t i = 0; i < count; ++i) {
        double to = index->number(indices.data + first_index + i * index->bytes, false);
        if (!(to < double(from.count)))
            return refuse(fmt::format("its sparse index {} is {}, beyond its {} elements", i, to,
                                      from.count));
        for (uint32_t k = 0; k < out.width; ++k)
            out.values[size_t(to) * out.width + k] = float(component->number(
                values.data + first_value + i * bytes + k * component->bytes, from.normalized));
    }
    return true;
}

// Indices keep all their bits: a float holds 24.
bool AccessorReader::read_indices(int accessor, std::vector<uint32_t>& out) {
    if (!has_index(accessor, model_.accessors.size())) return false;
    const tinygltf::Accessor& from = model_.accessors[size_t(accessor)];
    const ComponentRow* component = find_component(from.componentType);
    std::string own = fmt::format("/accessors/{}", accessor);
    if (!component || !component->index || from.type != TINYGLTF_TYPE_SCALAR) {
        report_.add(Code::GLTF_ACCESSOR, own, accessor, "indices are unsigned integers");
        return false;
    }
    if (from.bufferView < 0 || from.sparse.isSparse) {
        AccessorNumbers numbers;
        if (!read(accessor, numbers)) return false;
        for (float value : numbers.values) out.push_back(uint32_t(value));
        return true;
    }
    View view = view_bytes(from.bufferView, accessor);
    if (!view.data) return false;
    if (view.stride == 0) view.stride = component->bytes;
    if (!fits(view.size, from.byteOffset, view.stride, component->bytes, from.count)) {
        report_.add(Code::GLTF_ACCESSOR, own, accessor,
                    "it reaches past the end of its buffer view");
        return false;
    }
    if (!budget_.charge(from.count * sizeof(uint32_t), own)) return false;
    out.resize(from.count);
    for (size_t i = 0; i < from.count; ++i)
        out[i] = uint32_t(component->number(view.data + from.byteOffset + i * view.stride, false));
    return true;
}

bool AccessorReader::read_vertices(int accessor, std::span<const uint32_t> widths, size_t count,
                                   const std::string& pointer, AccessorNumbers& out) {
    if (!read(accessor, out)) return false;
    if (std::find(widths.begin(), widths.end(), out.width) == widths.end()) {
        report_.add(Code::GLTF_ACCESSOR, pointer, accessor,
                    fmt::format("this attribute cannot have {} numbers a vertex", out.width));
        return false;
    }
    if (out.count() != count) {
        report_.add(Code::GLTF_ACCESSOR, pointer, accessor,
                    fmt::format("it has {} vertices, the primitive's positions are {}", out.count(),
                                count));
        return false;
    }
    for (float& value : out.values)
        if (!std::isfinite(value)) value = 0.0f;
    return true;
}

}  // namespace kinora
