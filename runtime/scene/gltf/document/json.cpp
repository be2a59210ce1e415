// runtime/scene/gltf/document/json.cpp: JSON as text.
#include "runtime/scene/gltf/document/json.h"

#include <nlohmann/json.hpp>

namespace kinora {

std::string text_of(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace kinora
