// runtime/scene/gltf/file/indices.h: every index of a glTF file, checked by indices.def before
// tinygltf makes an int of it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/scene/gltf/file/json_scan.h"

namespace kinora {

// A value that should be an index and names nothing, or an object and is none.
struct GltfIndexFault {
    std::string pointer;
    const char* name;   // of what it should be the index of: "node"; null: an object
    std::string value;  // as written
    JsonRange range;
};

struct GltfIndices {
    std::string not_a_list;              // pointer to what should be an array and is not, or ""
    std::vector<GltfIndexFault> faults;  // the first kMaxGltfFindings
    size_t fault_count = 0;
    // The text, with kNoGltfIndex or {} for each value that is faulty or missing; "" if none is.
    std::string mended;
};

// An index that no list has and an int holds. What has it names nothing, as before.
inline constexpr const char* kNoGltfIndex = "2147483647";

// The time is linear in the text. Nesting is limited by check_gltf_json(), which comes before.
GltfIndices check_gltf_indices(std::string_view json);

}  // namespace kinora
