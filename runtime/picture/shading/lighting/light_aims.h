// runtime/picture/shading/lighting/light_aims.h: lights that shine only against where they look.
#pragma once

#include "runtime/base/diagnostic.h"
#include "runtime/picture/lights/light_bindings.h"
#include "runtime/picture/shading/frame/frame.h"

namespace kinora {

// Names them (LIGHT_AIMS_BACK).
void report_aims(const ShadingFrame& frame, const LightBindings& bindings,
                 Diagnostics& diagnostics);

}  // namespace kinora
