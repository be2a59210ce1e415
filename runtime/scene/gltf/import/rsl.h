// runtime/scene/gltf/import/rsl.h: extras.kinora_rsl: RSL shaders on what glTF has.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "rsl/link.h"
#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/gltf/import/textures.h"

namespace kinora {

class RslExtras {
  public:
    RslExtras(const GltfFile& file, const ImportOptions& options, TextureImporter& textures,
              PointerSlots& pointers, GltfReport& report, Diagnostics& diagnostics,
              SceneDescription& out)
        : file_(file),
          options_(options),
          textures_(textures),
          pointers_(pointers),
          report_(report),
          diagnostics_(diagnostics),
          out_(out) {}

    // kinora_rsl of a scene or a camera: "atmosphere" and "imagers". `pointer` is that of the owner
    // of the extras.
    PictureShaders picture_shaders(const tinygltf::Value& extras, const std::string& pointer);

    // kinora_rsl of a light: "light", and "ambient" where it has no position. False where there is
    // none.
    bool import_light(const tinygltf::Value& extras, const std::string& pointer,
                      LightDefinition& to);

    // kinora_rsl of a material: its stages replace what `to` has. Returns the vertex inputs of
    // parameters.
    std::vector<VertexBinding> import_material(const tinygltf::Value& rsl,
                                               const std::string& pointer, MaterialDefinition& to);

  private:
    using Shaders = std::vector<std::shared_ptr<const rsl::Shader>>;

    std::vector<ShaderUse> read_stage(const tinygltf::Value& object, const char* stage,
                                      rsl::ShaderKind kind, const std::string& pointer);
    struct SharedParams {  // those of all layers
        const tinygltf::Value* values;
        std::string pointer;
    };
    ShaderUse read_layer(const tinygltf::Value& layer, const SharedParams& shared,
                         rsl::ShaderKind kind, const std::string& pointer);
    struct LayerCode {
        std::string text;  // "" of a shader of the program's own
        SourceMap map;
        Shaders shaders;
    };
    LayerCode read_code(const tinygltf::Value& layer, const std::string& pointer);
    void compile(LayerCode& code, bool report);
    rsl::CompileOptions compile_options() const;
    rsl::LinkTexts link_texts(const tinygltf::Value& layer, const std::string& prefix) const;
    rsl::LinkCounts link_counts(const tinygltf::Value& layer, const std::string& prefix) const;
    std::shared_ptr<const rsl::Shader> linked(const tinygltf::Value& layer,
                                              const tinygltf::Value* co_shaders,
                                              const LayerCode& code, const rsl::Shader& shader,
                                              const std::string& pointer);
    void set_params(const tinygltf::Value& layer, const SharedParams& shared,
                    const std::string& pointer, ShaderUse& use);
    void set_param(ShaderUse& use, const std::string& name, const tinygltf::Value& value,
                   const std::string& pointer);
    bool read_strings(const tinygltf::Value& value, const std::string& pointer,
                      ParamSource& source);
    std::string texture_of(const tinygltf::Value& value, int texture, const std::string& pointer);
    void report_unknown(const rsl::Shader& shader, const std::string& name,
                        const std::string& pointer);

    const GltfFile& file_;
    const ImportOptions& options_;
    TextureImporter& textures_;
    PointerSlots& pointers_;
    GltfReport& report_;
    Diagnostics& diagnostics_;
    SceneDescription& out_;
};

}  // namespace kinora
