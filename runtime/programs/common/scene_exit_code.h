// runtime/programs/common/scene_exit_code.h: the exit code of a program that cannot show a scene.
#pragma once

#include "runtime/kinora/scene_error.h"
#include "runtime/programs/common/exit_codes.h"

namespace kinora {

inline int exit_code_of(SceneError error) {
    switch (error) {
        case SceneError::None:
            return kExitOk;
        case SceneError::Unreadable:
            return kExitUnreadable;
        case SceneError::Request:
            return kExitUsage;
        case SceneError::Shader:
            return kExitShader;
        case SceneError::Memory:
            return kExitRetry;
        case SceneError::Internal:
            return kExitInternal;
    }
    return kExitUnreadable;
}

}  // namespace kinora
