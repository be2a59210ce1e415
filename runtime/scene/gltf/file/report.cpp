// runtime/scene/gltf/file/report.cpp: findings of a glTF file by JSON pointer.
#include "runtime/scene/gltf/file/report.h"

#include <algorithm>

#include "runtime/scene/description/findings.h"
#include "runtime/scene/gltf/file/json_scan.h"

namespace kinora {

void GltfReport::finish() {
    if (count_ > kMaxGltfFindings)
        diagnostics_.report(Code::GLTF_MORE, location(""), count_ - kMaxGltfFindings);
}

std::vector<Location> GltfReport::locations(std::string_view pointer, size_t count) const {
    std::vector<Location> found(count);
    if (file_.file == kNoFile) return found;
    std::vector<JsonRange> elements = json_elements(file_.json, pointer);
    for (size_t e = 0; e < std::min(count, elements.size()); ++e)
        found[e] = {file_.file, elements[e].begin, elements[e].end};
    return found;
}

}  // namespace kinora
