// runtime/gltf/export/materials.h: materials of primitives.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "runtime/gltf/export/rsl.h"
#include "runtime/gltf/export/surfaces.h"

namespace kinora {

class MaterialWriter {
  public:
    MaterialWriter(const SceneDescription& description, GltfLooks& looks, SurfaceWriter& surfaces,
                   RslWriter& rsl, GltfDocument& document, LossReport& losses)
        : description_(description),
          looks_(looks),
          surfaces_(surfaces),
          rsl_(rsl),
          document_(document),
          losses_(losses) {}

    // The material of a group of a mesh.
    uint32_t write(const MeshUse& use, const PrimitiveGroup& group);

  private:
    void report_losses(const MaterialDefinition& definition, const char* extras);

    const SceneDescription& description_;
    GltfLooks& looks_;
    SurfaceWriter& surfaces_;
    RslWriter& rsl_;
    GltfDocument& document_;
    LossReport& losses_;
    std::map<std::string, uint32_t> materials_;  // of their JSON
    std::set<const MaterialDefinition*> reported_;
};

}  // namespace kinora
