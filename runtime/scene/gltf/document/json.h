// runtime/scene/gltf/document/json.h: JSON that keeps the order of its members, without its
// definition.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace kinora {

using Json = nlohmann::ordered_json;

// Its text, whatever bytes its strings hold.
std::string text_of(const Json& json);

}  // namespace kinora
