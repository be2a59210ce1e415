// #include "x.h", <x.h>, by macro, guarded headers without a last newline
#include "parts.h"
#include <parts.h>
#define HEADER "parts.h"
#include HEADER
surface preprocessor_include() { Ci = half(s) * PART_SCALE; }
