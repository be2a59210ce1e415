// What headers and macros write is theirs.
#include "noises.h"
#include "material.h"
#define SLOT(name) float name##_s = 0; float name##_t = 0
surface x(SLOT(map); float scale = 2;) {
    Ci = snoise(P * scale) + map_s;
}
