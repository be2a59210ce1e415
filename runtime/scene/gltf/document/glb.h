// runtime/scene/gltf/document/glb.h: the chunks of a .glb (glTF 2.0, 4.4).
#pragma once

#include <string>

namespace kinora {

// The JSON, and the buffer it speaks of ("" if none).
struct GlbParts {
    std::string json, buffer;
};

std::string join_glb(const GlbParts& parts);
GlbParts split_glb(const std::string& glb);

}  // namespace kinora
