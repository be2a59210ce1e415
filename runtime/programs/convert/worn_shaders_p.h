// runtime/programs/convert/worn_shaders_p.h: which shader of the command line stands where.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "runtime/scene/load/override_shader.h"

namespace kinora {

// What --shader gave so far.
class WornShaders {
  public:
    // CONVERT_STAGE_TWICE where an earlier --shader gave that stage of the material or light.
    void put(std::string_view wearer, std::string_view id, rsl::ShaderKind kind,
             const std::string& given, Diagnostics& diagnostics);

  private:
    std::map<std::pair<std::string, rsl::ShaderKind>, std::string> given_;
};

// override_shader, with a finding where it replaces what an earlier one gave.
bool put_shader(SceneDescription& scene, const std::string& pattern, const ShaderGiven& given,
                WornShaders& worn, Diagnostics& diagnostics);

}  // namespace kinora
