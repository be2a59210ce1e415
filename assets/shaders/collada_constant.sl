/* collada_constant.sl: COLLADA 1.4.1 <constant>: emission alone.
   Both sides are lit. */
#include "collada_slots.h"

surface collada_constant(
    SLOT(emission, 0);
    SLOT(ambient_color, 0);
    SLOT(diffuse, 0);
    SLOT(specular, 0);
    float shininess = 0;
    SLOT(reflective, 0);
    float reflectivity = 0;
    SLOT(transparent, 1);
    float transparent_alpha = 1;
    float transparency = 1;
    float index_of_refraction = 1;
    string opaque = "A_ONE";) {
    normal Nf = faceforward(normalize(N), I);
    vector In = normalize(I);
    color C = COLOR_OF(emission) * Cs;
    Oi = slot_opacity(transparent, transparent_map, transparent_s, transparent_t,
                      transparent_alpha, transparency, opaque);
    C += mirrored(COLOR_OF(reflective), reflectivity, Nf, In, Oi, color(1));
    Ci = Oi * C;
}
