// runtime/scene/gltf/export/cameras.h: cameras.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "runtime/scene/gltf/export/bounds.h"
#include "runtime/scene/gltf/export/rsl.h"

namespace kinora {

class CameraWriter {
  public:
    CameraWriter(const SceneDescription& description, const SceneBounds& bounds, RslWriter& rsl,
                 PointerMotion& motion, GltfDocument& document, LossReport& losses)
        : description_(description),
          bounds_(bounds),
          rsl_(rsl),
          motion_(motion),
          document_(document),
          losses_(losses) {}

    uint32_t write(uint32_t camera);

  private:
    uint32_t write_new(const CameraDefinition& definition);
    // By the values of a time.
    Json optics(const CameraDefinition& definition, const std::vector<double>& values);
    Json orthographic(const CameraDefinition& definition, const std::vector<double>& values) const;
    Json perspective(const CameraDefinition& definition, const std::vector<double>& values);

    const SceneDescription& description_;
    const SceneBounds& bounds_;
    RslWriter& rsl_;
    PointerMotion& motion_;
    GltfDocument& document_;
    LossReport& losses_;
    std::map<uint32_t, uint32_t> cameras_;  // of definitions
};

}  // namespace kinora
