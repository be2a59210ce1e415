// runtime/texture.h: texture and environment lookups for shaders.
#pragma once

#include "jit/target.h"

namespace kinora {

// The services "texture" and "environment" (rsl/renderer_services.h lists arguments and results).
// An image that cannot be read gives magenta and black checks and one finding.
void lookup_texture(const jit::ServiceCall& call);
void lookup_environment(const jit::ServiceCall& call);

}  // namespace kinora
