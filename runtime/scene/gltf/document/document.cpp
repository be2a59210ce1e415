// runtime/scene/gltf/document/document.cpp: the JSON of a glTF file while it is written.
#include "runtime/scene/gltf/document/document.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "runtime/scene/description/scene_description.h"

namespace kinora {

GltfDocument::GltfDocument() : json_(std::make_unique<Json>()) {
    (*json_)["asset"] = {{"version", "2.0"}, {"generator", "kinora-convert"}};
    (*json_)["scene"] = 0;
    (*json_)["scenes"] = Json::array({Json::object()});
}

GltfDocument::~GltfDocument() = default;

void GltfDocument::begin(const char* list) {
    (*json_)[list];
}

uint32_t GltfDocument::add(const char* list, Json element) {
    Json& elements = (*json_)[list];
    elements.push_back(std::move(element));
    return uint32_t(elements.size() - 1);
}

uint32_t GltfDocument::add_node(Json element, uint32_t parent) {
    uint32_t index = add("nodes", std::move(element));
    Json& siblings = parent == kNone ? scene()["nodes"] : node(parent)["children"];
    siblings.push_back(index);
    return index;
}

uint32_t GltfDocument::add_light(Json light) {
    Json& lights = (*json_)["extensions"]["KHR_lights_punctual"]["lights"];
    lights.push_back(std::move(light));
    return uint32_t(lights.size() - 1);
}

void GltfDocument::use_extension(const char* name) {
    if (std::find(extensions_.begin(), extensions_.end(), name) == extensions_.end())
        extensions_.push_back(name);
}

void GltfDocument::hide(uint32_t index) {
    node(index)["extensions"]["KHR_node_visibility"]["visible"] = false;
    use_extension("KHR_node_visibility");
    ++hidden_;
}

Json& GltfDocument::list(const char* name) {
    return (*json_)[name];
}

Json& GltfDocument::node(uint32_t index) {
    return (*json_)["nodes"][index];
}

Json* GltfDocument::find(const std::string& pointer) {
    Json::json_pointer path(pointer);
    return json_->contains(path) ? &json_->at(path) : nullptr;
}

void GltfDocument::set(const std::string& pointer, Json value) {
    (*json_)[Json::json_pointer(pointer)] = std::move(value);
}

Json& GltfDocument::scene() {
    return (*json_)["scenes"][0];
}

bool GltfDocument::has(const char* list) const {
    return json_->contains(list);
}

std::string GltfDocument::text(size_t buffer_bytes) {
    if (!extensions_.empty()) (*json_)["extensionsUsed"] = extensions_;
    if (buffer_bytes) add("buffers", {{"byteLength", buffer_bytes}});
    return text_of(*json_);
}

}  // namespace kinora
