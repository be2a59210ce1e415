// runtime/scene/gltf/document/document.h: the JSON of a glTF file while it is written.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "runtime/scene/gltf/document/json.h"

namespace kinora {

inline constexpr const char* kAnimationPointer = "KHR_animation_pointer";

// Lists ("meshes", "nodes") whose elements name each other by index, and one scene. A list stands
// in the file where it began, so a file's bytes follow from the order of calls. References are
// valid until the next element is added.
class GltfDocument {
  public:
    GltfDocument();
    ~GltfDocument();

    // Begins a list before its first element.
    void begin(const char* list);
    // Returns the index.
    uint32_t add(const char* list, Json element);
    // Below `parent`, or at the scene's top (kNone).
    uint32_t add_node(Json node, uint32_t parent);
    uint32_t add_light(Json light);  // of KHR_lights_punctual
    void use_extension(const char* name);
    void hide(uint32_t node);  // and what is below (KHR_node_visibility)
    uint32_t hidden() const { return hidden_; }

    Json& list(const char* name);  // begun if need be
    Json& node(uint32_t index);
    Json* find(const std::string& pointer);  // null: nothing is there
    void set(const std::string& pointer, Json value);
    Json& scene();
    bool has(const char* list) const;

    // The file's JSON, with a buffer of so many bytes.
    std::string text(size_t buffer_bytes);

  private:
    std::unique_ptr<Json> json_;
    std::vector<std::string> extensions_;
    uint32_t hidden_ = 0;
};

}  // namespace kinora
