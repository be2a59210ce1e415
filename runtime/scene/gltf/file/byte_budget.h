// runtime/scene/gltf/file/byte_budget.h: how much memory a file may take.
#pragma once

#include <string>

#include "runtime/scene/gltf/file/report.h"

namespace kinora {

// What a file can ask for is bounded by its size.
class ByteBudget {
  public:
    ByteBudget(const GltfFile& file, GltfReport& report)
        : report_(report), allowed_((size_t(64) << 20) + 20 * file.bytes) {}

    // Whether so many more bytes may be taken; the first time that they may not is a finding.
    bool charge(size_t bytes, const std::string& pointer);

  private:
    GltfReport& report_;
    size_t allowed_, charged_ = 0;
    bool reported_ = false;
};

}  // namespace kinora
