/* collada_lambert.sl: COLLADA 1.4.1 <lambert>: emission, ambient and diffuse light.
   Both sides are lit. */
#include "collada_slots.h"

surface collada_lambert(
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
    string opaque = "A_ONE";
    SLOT(bump, 0);
    string bump_kind = "";
    float bump_amount = 1;
    float emission_of_body = 0;) {
    normal Nf = faceforward(bumped(bump_map, bump_kind, bump_s, bump_t, bump_amount), I);
    vector In = normalize(I);
    color C = EMISSION + AMBIENT_COLOR * ambient() + BODY_COLOR * diffuse(Nf);
    Oi = slot_opacity(transparent, transparent_map, transparent_s, transparent_t,
                      transparent_alpha, transparency, opaque);
    C += mirrored(COLOR_OF(reflective), reflectivity, Nf, In, Oi, BODY_COLOR);
    Ci = Oi * C;
}
