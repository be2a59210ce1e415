// runtime/scene/gltf/export/looks.h: what a primitive wears, and which vertex attributes are
// written.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/scene/description/scene_description.h"
#include "runtime/scene/gltf/document/loss_report.h"

namespace kinora {

// What a primitive wears.
struct GltfLook {
    const MaterialDefinition& definition;
    const MaterialUse& bound;
    bool is_plain;  // it has no material
    bool is_gltf;   // one of glTF's own, as import_gltf makes them
    bool tinted;    // COLOR multiplies it, but not COLOR's alpha: profile_COMMON, no material
};

struct GltfAttribute {
    std::string name;  // "TEXCOORD_0", "_HEAT"
    const VertexAttribute* attribute;
    uint32_t width;                 // numbers an element
    const VertexAttribute* values;  // of the same corners: kLinearColor where the look reads that
};

class GltfLooks {
  public:
    GltfLooks(const SceneDescription& description, Diagnostics& diagnostics)
        : description_(description), diagnostics_(diagnostics) {}

    GltfLook look_of(const MeshUse& use, const PrimitiveGroup& group);

  private:
    const SceneDescription& description_;
    Diagnostics& diagnostics_;
    MaterialDefinition plain_;  // what has no material
    MaterialUse unbound_;
};

// In the order of their sets. What glTF's own materials show has glTF's names; what only shaders
// read has names of the application's own, "_HEAT", which viewers leave alone (glTF 2.0, 3.7.2.1).
// Texture coordinates are for both.
std::vector<GltfAttribute> attributes_of(const GltfLook& look, const PrimitiveGroup& group,
                                         LossReport& losses);

// Which TEXCOORD_n the texture_coordinates of a texcoord name are.
uint32_t texcoord_index(const std::string& name, const MaterialUse& use,
                        const PrimitiveGroup& group);

}  // namespace kinora
