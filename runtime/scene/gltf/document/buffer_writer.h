// runtime/scene/gltf/document/buffer_writer.h: the buffer of a glTF file, its views and accessors.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/scene/gltf/document/document.h"

namespace kinora {

class BufferWriter {
  public:
    explicit BufferWriter(GltfDocument& document) : document_(document) {}

    // A buffer view of these bytes; `target` is OpenGL's number, 0 for none.
    uint32_t view(const void* data, size_t size, int target);

    // An accessor of elements of `width` numbers: float, uint8_t, uint16_t or uint32_t. `bounds`:
    // with "min" and "max". 0 stands for floats that are not finite.
    template <class T>
    uint32_t accessor(std::vector<T> numbers, uint32_t width, int target, bool bounds);
    size_t unsound() const { return unsound_; }  // for how many so far

    const std::string& bytes() const { return bytes_; }

  private:
    void mend(std::vector<float>& numbers);

    GltfDocument& document_;
    std::string bytes_;
    size_t unsound_ = 0;
};

}  // namespace kinora
