// runtime/scene/gltf/export/surfaces.h: surface shaders as glTF's pbrMetallicRoughness.
#pragma once

#include <string>

#include "runtime/scene/gltf/export/looks.h"
#include "runtime/scene/gltf/export/params.h"
#include "runtime/scene/gltf/export/textures.h"

namespace kinora {

class SurfaceWriter {
  public:
    SurfaceWriter(TextureWriter& textures, GltfDocument& document, LossReport& losses)
        : textures_(textures), document_(document), losses_(losses) {}

    // A fixed-function material of COLLADA (collada_*.sl), by the values of a time.
    Json common(const MaterialDefinition& definition, const UsedParams& params,
                const MaterialUse& use, const PrimitiveGroup& group);

    // What import_gltf makes of glTF's own materials, written back; `is_all` becomes false where
    // they say more than glTF does.
    Json pbr(const UsedParams& params, const MaterialUse& use, const PrimitiveGroup& group,
             bool& is_all);

  private:
    // Of a slot's map; null where there is none.
    Json map_info(const ShaderUse& shader, const std::string& slot, const MaterialUse& use,
                  const PrimitiveGroup& group);
    Json texture_info(const ParamSource& map, const MaterialUse& use, const PrimitiveGroup& group);
    Json pbr_map_info(const UsedParams& params, const std::string& slot, bool data,
                      const MaterialUse& use, const PrimitiveGroup& group, bool& is_all);
    void write_emission(const UsedParams& params, Json& material);
    void write_specular_glossiness(const UsedParams& params, Json& pbr, Json texture,
                                   Json& material, bool& is_all);
    void write_reflection(const UsedParams& params, Json& material, bool& is_all);
    void extend(Json& material, const char* extension, Json value);

    TextureWriter& textures_;
    GltfDocument& document_;
    LossReport& losses_;
};

// Whether the surface shader is one of collada_*.sl.
bool is_common_surface(const ShaderUse& shader);

}  // namespace kinora
