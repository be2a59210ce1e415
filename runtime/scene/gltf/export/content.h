// runtime/scene/gltf/export/content.h: what hangs on the nodes: meshes, cameras, lights.
#pragma once

#include "runtime/scene/gltf/export/cameras.h"
#include "runtime/scene/gltf/export/lights.h"
#include "runtime/scene/gltf/export/meshes.h"
#include "runtime/scene/gltf/export/skins.h"

namespace kinora {

class ContentWriter {
  public:
    ContentWriter(const SceneDescription& description, const Occurrences& occurrences,
                  MeshWriter& meshes, SkinWriter& skins, CameraWriter& cameras, LightWriter& lights,
                  NodeWriter& nodes, NodeMotion& motion, GltfDocument& document)
        : description_(description),
          occurrences_(occurrences),
          meshes_(meshes),
          skins_(skins),
          cameras_(cameras),
          lights_(lights),
          nodes_(nodes),
          motion_(motion),
          document_(document) {}

    void write(uint32_t occurrence);

  private:
    uint32_t free_node(uint32_t node, const char* pointer);
    void write_mesh(const MeshUse& use, uint32_t occurrence);

    const SceneDescription& description_;
    const Occurrences& occurrences_;
    MeshWriter& meshes_;
    SkinWriter& skins_;
    CameraWriter& cameras_;
    LightWriter& lights_;
    NodeWriter& nodes_;
    NodeMotion& motion_;
    GltfDocument& document_;
};

}  // namespace kinora
