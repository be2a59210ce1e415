// runtime/player/pace/patience.h: how long a quick picture is waited for.
#pragma once

#include <cstddef>

namespace kinora {

// Milliseconds that a quick picture may take while a newer order waits for its end. `rate`:
// pictures a second to hold; `ended`: so many before it, one after the other, were ended for taking
// longer. Each of these doubles the time, so that an endless row of orders does get its next
// picture.
double patience_ms(double rate, size_t ended);

}  // namespace kinora
