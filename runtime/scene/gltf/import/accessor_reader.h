// runtime/scene/gltf/import/accessor_reader.h: the numbers of accessors, every byte checked.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/scene/gltf/file/byte_budget.h"
#include "runtime/scene/gltf/file/report.h"

namespace kinora {

// Numbers of an accessor, `width` an element.
struct AccessorNumbers {
    uint32_t width = 0;
    std::vector<float> values;
    size_t count() const { return width ? values.size() / width : 0; }
};

// `pointer` is that of the value that names the accessor. False where the accessor is not sound,
// which is then a finding.
class AccessorReader {
  public:
    AccessorReader(const tinygltf::Model& model, GltfReport& report, ByteBudget& budget)
        : model_(model), report_(report), budget_(budget) {}

    bool read(int accessor, AccessorNumbers& out);
    bool read_indices(int accessor, std::vector<uint32_t>& out);
    // An attribute of `count` vertices with one of the widths; not finite numbers become 0.
    bool read_vertices(int accessor, std::span<const uint32_t> widths, size_t count,
                       const std::string& pointer, AccessorNumbers& out);

  private:
    struct View {
        const uint8_t* data = nullptr;
        size_t size = 0, stride = 0;
    };
    View view_bytes(int view, int accessor);
    bool read_sparse(int accessor, AccessorNumbers& out);

    const tinygltf::Model& model_;
    GltfReport& report_;
    ByteBudget& budget_;
};

}  // namespace kinora
