// runtime/scene/gltf/file/report.h: findings of a glTF file by JSON pointer.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/diagnostic.h"
#include "runtime/scene/gltf/file/file.h"

namespace kinora {

// Whether a list of `count` has that index. Where it has not, check_gltf_indices() has reported it.
inline bool has_index(int index, size_t count) {
    return index >= 0 && size_t(index) < count;
}

// The first kMaxGltfFindings are reported, the rest is counted.
class GltfReport {
  public:
    GltfReport(const GltfFile& file, Diagnostics& diagnostics)
        : file_(file), diagnostics_(diagnostics) {}

    // The finding, or null where there are too many.
    template <class... Args>
    Finding* add(const FindingInfo& info, const std::string& pointer, const Args&... args) {
        if (++count_ > kMaxGltfFindings) return nullptr;
        Finding& finding = diagnostics_.report(info, location(pointer), args...);
        finding.id_path = pointer;
        return &finding;
    }

    // How many findings were only counted, as a finding.
    void finish();

    Location location(const std::string& pointer) const { return gltf_location(file_, pointer); }

    // Of the first `count` elements of the array that a pointer names, in one pass over the text.
    std::vector<Location> locations(std::string_view pointer, size_t count) const;

  private:
    const GltfFile& file_;
    Diagnostics& diagnostics_;
    size_t count_ = 0;
};

}  // namespace kinora
