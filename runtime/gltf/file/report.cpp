// runtime/gltf/file/report.cpp: findings of a glTF file by JSON pointer.
#include "runtime/gltf/file/report.h"

#include "runtime/description/findings.h"

namespace kinora {

bool GltfReport::exists(int index, size_t count, const char* what, const std::string& pointer) {
    if (index >= 0 && size_t(index) < count) return true;
    add(Code::GLTF_REFERENCE, pointer, what, index);
    return false;
}

void GltfReport::finish() {
    if (count_ > kMaxGltfFindings)
        diagnostics_.report(Code::GLTF_MORE, location(""), count_ - kMaxGltfFindings);
}

}  // namespace kinora
