// runtime/import_gltf_check.h: what must hold of a glTF's JSON before tinygltf sees it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace kinora {

// What "buffers" of a glTF's JSON says of each; none where the JSON cannot be read.
struct GltfBuffer {
    std::string uri;  // "" for the .glb's own and for data URIs
    bool data = false;
    size_t bytes = 0;
};
std::vector<GltfBuffer> gltf_buffers(std::string_view json);

// "" or why the file is refused: JSON nested too deep or too large for its `bytes`, several buffers
// that would each copy a .glb's binary chunk, images outside their buffers.
std::string check_gltf_json(std::string_view json, size_t bytes, bool binary);

}  // namespace kinora
