// runtime/scene/gltf/export/rsl.h: shaders as extras.kinora_rsl, which import_gltf reads.
#pragma once

#include <string>
#include <vector>

#include "runtime/scene/description/rsl_literals.h"
#include "runtime/scene/gltf/curves/pointer_motion.h"
#include "runtime/scene/gltf/export/looks.h"
#include "runtime/scene/gltf/export/textures.h"

namespace kinora {

class RslWriter {
  public:
    // `link`: GltfExportOptions.
    RslWriter(const SceneDescription& description, TextureWriter& textures, PointerMotion& motion,
              LossReport& losses, const FileLink& link)
        : description_(description),
          textures_(textures),
          motion_(motion),
          losses_(losses),
          link_(link) {}

    // {"library": name} or {"code", "shader"}, and "params".
    Json shader(const ShaderUse& use);
    // One, or a list of layers.
    Json stage(const std::vector<ShaderUse>& uses);
    // "atmosphere" and "imagers"; an empty object where there are none.
    Json picture(const PictureShaders& picture);
    // The stages of a material on a group; an empty object where there are none.
    Json material(const GltfLook& look, const PrimitiveGroup& group);

    // The curves of parameters that stand below `pointer`, where these have put them.
    void move_stage(const std::string& pointer, const std::vector<ShaderUse>& uses);
    void move_shader(const std::string& pointer, const ShaderUse& use);
    void move_picture(const std::string& pointer, const PictureShaders& picture);
    void move_material(const std::string& pointer, const GltfLook& look);

  private:
    std::string code(const rsl::Shader& shader, size_t part) const;
    void add_co_shaders(const rsl::Shader& shader, Json& result, Json& params) const;
    void set_strings(const ParamSource& source, Json& params);
    Json bound_stage(const std::vector<ShaderUse>& uses, const MaterialUse& bound,
                     const PrimitiveGroup& group);

    const SceneDescription& description_;
    TextureWriter& textures_;
    PointerMotion& motion_;
    LossReport& losses_;
    FileLink link_;
};

}  // namespace kinora
