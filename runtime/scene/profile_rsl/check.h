// runtime/scene/profile_rsl/check.h: what can be said of a document's profile_RSL without rendering
// it.
#pragma once

#include "collada/scene/scene.h"
#include "rsl/text/compile_options.h"
#include "runtime/base/diagnostic.h"

namespace kinora {

// Compiles the code of every effect with profile_RSL and reports, at their locations in the
// document or the included file: errors of the code, stages without a shader, <bind>s and
// <setparam>s that fit no parameter, <bind>s of instances that name none, parameters and shaders
// nothing uses, stages where they have no meaning, files named where `options` does not let them be
// read. Costs nothing for a scene without RSL.
void check_profile_rsl(const collada::SceneData& scene, const rsl::CompileOptions& options,
                       Diagnostics& diagnostics);

}  // namespace kinora
