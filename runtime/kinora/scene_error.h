// runtime/kinora/scene_error.h: why there is no picture of a scene.
#pragma once

#include <cstdint>

#include "runtime/base/diagnostic.h"

namespace kinora {

// The findings say more.
enum class SceneError : uint8_t {
    None,
    Unreadable,  // the file is missing, is no scene, or cannot be rendered
    Request,     // an option names what the scene lacks, or has a value that it cannot have
    Shader,      // a shader has errors
    Memory,      // there is not enough memory
    Internal,    // a check of ourselves failed (CheckFailed)
};

// The first error among the findings that forbids a picture: Internal, Shader or Request.
// `otherwise` where there is none.
SceneError forbidding_error(const Diagnostics& diagnostics,
                            SceneError otherwise = SceneError::None);

}  // namespace kinora
