// runtime/gltf/export/rsl.h: shaders as extras.kinora_rsl, which import_gltf reads.
#pragma once

#include <vector>

#include "runtime/description/rsl_literals.h"
#include "runtime/gltf/export/looks.h"
#include "runtime/gltf/export/textures.h"

namespace kinora {

class RslWriter {
  public:
    // `link`: GltfExportOptions.
    RslWriter(const SceneDescription& description, TextureWriter& textures, LossReport& losses,
              const FileLink& link)
        : description_(description), textures_(textures), losses_(losses), link_(link) {}

    // {"library": name} or {"code", "shader"}, and "params".
    Json shader(const ShaderUse& use);
    // One, or a list of layers.
    Json stage(const std::vector<ShaderUse>& uses);
    // "atmosphere" and "imagers"; an empty object where there are none.
    Json picture(const PictureShaders& picture);
    // The stages of a material on a group; an empty object where there are none.
    Json material(const GltfLook& look, const PrimitiveGroup& group);

  private:
    std::string code(const rsl::Shader& shader, size_t part) const;
    void add_co_shaders(const rsl::Shader& shader, Json& result, Json& params) const;
    void set_strings(const ParamSource& source, Json& params);
    Json bound_stage(const std::vector<ShaderUse>& uses, const MaterialUse& bound,
                     const PrimitiveGroup& group);

    const SceneDescription& description_;
    TextureWriter& textures_;
    LossReport& losses_;
    FileLink link_;
};

}  // namespace kinora
