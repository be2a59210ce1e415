// runtime/scene/gltf/file/check.h: what must hold of a glTF's JSON before tinygltf sees it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace kinora {

// What "buffers" of a glTF's JSON says of each; none where the JSON cannot be read.
struct GltfBuffer {
    std::string uri;  // "" for the .glb's own and for data URIs
    bool data = false;
    size_t bytes = 0;
    std::string_view packed_by;  // the extension that makes its bytes from others; "": it has them
};
std::vector<GltfBuffer> gltf_buffers(std::string_view json);

// Cuts data URIs of buffers to the bytes that the buffer has: the URI's may be more (glTF 2.0,
// 3.6.1.1), which tinygltf refuses. Spaces fill the JSON to its old length.
void cut_gltf_data(std::span<char> json);

// "" or why the file is refused: JSON nested too deep or too large for its `bytes`.
std::string check_gltf_shape(std::string_view json, size_t bytes);

// The same: several buffers that would each copy a .glb's binary chunk, images outside their
// buffers.
std::string check_gltf_json(std::string_view json, bool binary);

}  // namespace kinora
