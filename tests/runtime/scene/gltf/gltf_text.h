// tests/runtime/scene/gltf/gltf_text.h: small glTF scenes written by tests.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/runtime/scene_text.h"

namespace kinora {

// The JSON as a tree, and the bytes of its one buffer. The camera is orthographic at (0,0,10),
// looks along -z and shows [-1,1] x [-1,1], as SceneText's.
struct GltfText {
    nlohmann::json json;
    std::vector<uint8_t> bytes;

    GltfText();
    // Each returns the index of what it added.
    int view(const void* data, size_t size, int stride = 0);
    int accessor(int view, int component_type, size_t count, const char* type,
                 size_t byte_offset = 0, bool normalized = false);
    int floats(const std::vector<float>& values, const char* type);
    int shorts(const std::vector<uint16_t>& values);  // indices
    int mesh(nlohmann::json attributes, int indices = -1, int material = -1, int mode = 4);
    int node(nlohmann::json node);
    int material(nlohmann::json material);
    // [-size, size] squared in the plane z = 0, two triangles, normals +z, uv 0,0 in the upper
    // left.
    int square(int material = -1, float size = 1);
    // A PNG of RGBA texels, row by row from the top, inside the buffer; the texture.
    int texture(int width, int height, const std::vector<uint8_t>& rgba, nlohmann::json sampler);
    // A channel of animation `animation`; times and values as they stand.
    void animate(int animation, int node, const char* path, const char* interpolation,
                 const std::vector<float>& times, const std::vector<float>& values);

    std::string glb() const;
    std::string gltf() const;  // the buffer as a data URI
};

// Writes the text to a file of its own, gone with this object.
class GltfFileOnDisk {
  public:
    explicit GltfFileOnDisk(const std::string& content, const char* extension = ".glb");
    ~GltfFileOnDisk();
    GltfFileOnDisk(const GltfFileOnDisk&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};

std::unique_ptr<Rendering> rendering_of(const GltfText& scene, const SceneOptions& options = {});
// The description alone.
struct GltfDescription {
    Diagnostics diagnostics;
    std::optional<SceneDescription> scene;
    int count(std::string_view code) const;
    std::string findings() const;
};
std::unique_ptr<GltfDescription> described(const std::string& content,
                                           const char* extension = ".glb");

// A scene with one of nearly everything: a texture, a skin, a morph, a light, animations.
GltfText whole_scene();

// Imports the file, builds its scene and renders a small frame. What is no scene has an error.
void survive(const std::string& content, const char* extension);

}  // namespace kinora
