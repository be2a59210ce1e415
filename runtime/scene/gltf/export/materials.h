// runtime/scene/gltf/export/materials.h: materials of primitives.
#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "runtime/scene/gltf/export/rsl.h"
#include "runtime/scene/gltf/export/surfaces.h"

namespace kinora {

class MaterialWriter {
  public:
    MaterialWriter(const SceneDescription& description, GltfLooks& looks, SurfaceWriter& surfaces,
                   RslWriter& rsl, PointerMotion& motion, GltfDocument& document,
                   LossReport& losses)
        : description_(description),
          looks_(looks),
          surfaces_(surfaces),
          rsl_(rsl),
          motion_(motion),
          document_(document),
          losses_(losses) {}

    // The material of a group of a mesh.
    uint32_t write(const MeshUse& use, const PrimitiveGroup& group);

  private:
    struct Surface {
        const char* extras;   // what of it only extras keep
        bool is_all = false;  // it has no need of extras
    };
    Json surface_at(const GltfLook& look, const PrimitiveGroup& group,
                    const std::vector<double>& values, Surface& surface);
    std::string moving_key(const GltfLook& look) const;
    void report_extras(const MaterialDefinition& definition, const char* extras);

    const SceneDescription& description_;
    GltfLooks& looks_;
    SurfaceWriter& surfaces_;
    RslWriter& rsl_;
    PointerMotion& motion_;
    GltfDocument& document_;
    LossReport& losses_;
    std::map<std::string, uint32_t> materials_;  // of their JSON and what moves it
    std::set<const MaterialDefinition*> reported_;
};

}  // namespace kinora
