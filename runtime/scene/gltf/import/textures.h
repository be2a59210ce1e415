// runtime/scene/gltf/import/textures.h: glTF's textures, samplers and images as names that shaders
// look up.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "runtime/base/picture_search.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/gltf/file/byte_budget.h"
#include "runtime/scene/gltf/pointers/pointer_slots.h"

namespace kinora {

// Any of tinygltf's texture infos.
struct GltfTextureInfo {
    int index, set;
    const tinygltf::ExtensionMap& extensions;
};

class TextureImporter {
  public:
    // Moves images out of file.model.
    TextureImporter(GltfFile& file, PointerSlots& pointers, GltfReport& report, ByteBudget& budget,
                    SceneDescription& out)
        : file_(file), pointers_(pointers), report_(report), budget_(budget), out_(out) {}

    // The name of a texture (texture_name.h); "" where it cannot be read.
    std::string texture_name(int texture, bool data);

    // Gives a shader X_map and what goes with it (assets/shaders/gltf_pbr.sl).
    void set_map(ShaderUse& use, const std::string& name, const GltfTextureInfo& info, bool data,
                 const std::string& pointer);

  private:
    void set_transform(ShaderUse& use, const std::string& name, const tinygltf::Value& transform,
                       const std::string& pointer);
    std::string image_path(int image);
    std::string find_picture(const std::string& uri, const std::string& pointer);

    GltfFile& file_;
    PointerSlots& pointers_;
    GltfReport& report_;
    ByteBudget& budget_;
    SceneDescription& out_;
    PictureSearch search_;
    std::map<int, std::string> images_;  // their paths
};

}  // namespace kinora
