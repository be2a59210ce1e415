/* collada_slots.h: what the shaders of COLLADA's fixed-function materials share (collada_*.sl):
   slots, opacity, reflections, bump maps. */
#ifndef COLLADA_SLOTS_H
#define COLLADA_SLOTS_H

#include "broadlights.h"

/* A slot is a color, or a texture ("" for none) at coordinates that may be another set's. */
#define SLOT(X, value)       \
    color X = value;         \
    string X##_map = "";     \
    varying float X##_s = s; \
    varying float X##_t = t

#define COLOR_OF(X) slot_color(X, X##_map, X##_s, X##_t)

/* What lights meet: <diffuse>, tinted by the mesh's vertex colors (1 where it has none). */
#define BODY_COLOR (COLOR_OF(diffuse) * Cs)

/* <emission>, or where the file means a factor by it (Blender before 2.80), so much of the body. */
#define EMISSION (COLOR_OF(emission) * emitting_body(emission_of_body, BODY_COLOR))

color emitting_body(float of_body; color body;) {
    color c = 1;
    if (of_body != 0) c = body;
    return c;
}

color slot_color(color plain; string map; float ss, tt;) {
    color c = plain;
    if (map != "") c = color texture(map, ss, tt);
    return c;
}

/* A plain ambient color beside a diffuse texture: exporters lock the two and write the texture
 * once. */
#define AMBIENT_COLOR               \
    (COLOR_OF(ambient_color) * Cs * \
     locked_texture(ambient_color_map, diffuse_map, diffuse_s, diffuse_t))

color locked_texture(string own, map; float ss, tt;) {
    color c = 1;
    if (own == "" && map != "") c = color texture(map, ss, tt);
    return c;
}

/* How much of what lies behind is hidden (COLLADA 1.4.1, <transparent opaque>): A_ONE by alpha,
   RGB_ONE by color; A_ZERO and RGB_ZERO the other way round; NONE hides all. */
color slot_opacity(color plain; string map; float ss, tt; float alpha, transparency;
                   string opaque;) {
    color Ot = 1;
    if (opaque == "A_ONE" || opaque == "A_ZERO") {
        float a = alpha;
        if (map != "") a = float texture(map[3], ss, tt);
        Ot = transparency * a;
    } else if (opaque == "RGB_ONE" || opaque == "RGB_ZERO") {
        Ot = transparency * slot_color(plain, map, ss, tt);
    }
    if (opaque == "A_ZERO" || opaque == "RGB_ZERO") Ot = 1 - Ot;
    return clamp(Ot, color(0), color(1));
}

/* Where rays are deep, either what is reflected or what lies behind the surface is followed. What
   only mirrors would be black in an empty scene: it mirrors broad lights too. */
color mirrored(color reflective; float reflectivity; normal Nf; vector In; color opacity, body;) {
    color c = 0;
    if (reflectivity > 0) {
        c = reflectivity * reflective;
        if (c != color(0)) {
            vector R = reflect(In, Nf);
            color seen = color trace(P, R, "weight", c * opacity, "opacity", opacity);
            if (body == color(0)) seen += broad_glow(P, Nf, R);
            c *= seen;
        }
    }
    return c;
}

/* The normal under a bump map: as if the surface stood out by amount / 20 of the image's side where
   the map is white. A map of kind NORMALMAP holds normals in the frame of dPdu, dPdv and N. */
normal bumped(string map, kind; float ss, tt, amount;) {
    normal Nn = normalize(N);
    if (map != "" && kind == "NORMALMAP") {
        color c = 2 * color texture(map, ss, tt) - 1;
        vector T = normalize(dPdu - (dPdu.Nn) * Nn);
        vector B = dPdv - (dPdv.Nn) * Nn;
        B = normalize(B - (B.T) * T);
        Nn = normalize(amount * (comp(c, 0) * T + comp(c, 1) * B) + comp(c, 2) * Nn);
    } else if (map != "") {
        float height = amount / 20 * sqrt(length(dPdu ^ dPdv)) * float texture(map, ss, tt);
        normal flat = normalize(calculatenormal(P));
        normal bent = normalize(calculatenormal(P + height * Nn));
        if (flat.Nn < 0) {
            flat = -flat;
            bent = -bent;
        }
        Nn = normalize(Nn + bent - flat);
    }
    return Nn;
}

#endif
