// runtime/scene/description/environment.h: what lies around a scene, lights it and is seen by rays
// that leave it.
#pragma once

#include <memory>
#include <string>

#include "rsl/compile.h"
#include "runtime/base/diagnostic.h"
#include "runtime/base/math.h"

namespace kinora {

struct EnvironmentDefinition {
    std::string picture;                        // a texture's name; "": one color all around
    std::shared_ptr<const rsl::Shader> shader;  // a light's with sample methods, instead of both
    dvec3 color{1.0};
    double brightness = 1;
    double rotation = 0;  // degrees about the up axis, counterclockwise as seen from above
    bool behind_picture = true;
    Location where;
};

}  // namespace kinora
