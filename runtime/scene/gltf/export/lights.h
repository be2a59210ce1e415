// runtime/scene/gltf/export/lights.h: lights as KHR_lights_punctual.
#pragma once

#include <cstdint>
#include <map>

#include "runtime/scene/gltf/export/bounds.h"
#include "runtime/scene/gltf/export/rsl.h"

namespace kinora {

class LightWriter {
  public:
    LightWriter(const SceneDescription& description, const SceneBounds& bounds, const dmat4& axes,
                RslWriter& rsl, PointerMotion& motion, GltfDocument& document, LossReport& losses)
        : description_(description),
          bounds_(bounds),
          axes_(axes),
          rsl_(rsl),
          motion_(motion),
          document_(document),
          losses_(losses) {}

    // A light that stands at `world` where it is first met.
    uint32_t write(uint32_t light, const dmat4& world);

  private:
    uint32_t write_new(const LightDefinition& definition, const dmat4& world);

    const SceneDescription& description_;
    const SceneBounds& bounds_;
    const dmat4& axes_;
    RslWriter& rsl_;
    PointerMotion& motion_;
    GltfDocument& document_;
    LossReport& losses_;
    std::map<uint32_t, uint32_t> lights_;  // of definitions
};

}  // namespace kinora
