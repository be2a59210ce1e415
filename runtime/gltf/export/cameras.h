// runtime/gltf/export/cameras.h: cameras.
#pragma once

#include <cstdint>
#include <map>

#include "runtime/gltf/export/bounds.h"
#include "runtime/gltf/export/rsl.h"

namespace kinora {

class CameraWriter {
  public:
    CameraWriter(const SceneDescription& description, const SceneBounds& bounds, RslWriter& rsl,
                 GltfDocument& document, LossReport& losses)
        : description_(description),
          bounds_(bounds),
          rsl_(rsl),
          document_(document),
          losses_(losses) {}

    uint32_t write(uint32_t camera);

  private:
    Json new_camera(const CameraDefinition& definition);
    Json orthographic(const CameraDefinition& definition) const;
    Json perspective(const CameraDefinition& definition);
    double number(ValueSlot slot) const;  // 0 where there is none

    const SceneDescription& description_;
    const SceneBounds& bounds_;
    RslWriter& rsl_;
    GltfDocument& document_;
    LossReport& losses_;
    std::map<uint32_t, uint32_t> cameras_;  // of definitions
};

}  // namespace kinora
