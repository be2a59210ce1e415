// runtime/scene/description/display_color.h: colours of a display, which old files hold, as linear
// light.
#pragma once

#include "runtime/base/math.h"

namespace kinora {

// Decodes each component from sRGB (IEC 61966-2-1). m is the largest magnitude among the three:
// above 1 the colour is m * decode(c / m), so that twice the numbers are twice the light.
// A negative component is minus what its magnitude gives. NaN gives 0. Beside an infinite component
// a finite one is c / 12.92, the limit of the formula.
dvec3 linear_of_display(const dvec3& color);

// The inverse: what a file has to say so that it is read as this colour.
dvec3 display_of_linear(const dvec3& color);

}  // namespace kinora
