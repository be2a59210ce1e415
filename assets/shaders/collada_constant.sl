/* collada_constant.sl: COLLADA 1.4.1 <constant>: emission alone.
   Both sides are lit. */
/* A slot is a color, or a texture ("" for none) at coordinates that may be another set's. */
#define SLOT(X, value)                                                                             \
    color X = value;                                                                               \
    string X##_map = "";                                                                           \
    varying float X##_s = s;                                                                       \
    varying float X##_t = t

#define COLOR_OF(X) slot_color(X, X##_map, X##_s, X##_t)

color slot_color(color plain; string map; float ss, tt;) {
    color c = plain;
    if (map != "")
        c = color texture(map, ss, tt);
    return c;
}

/* How much of what lies behind is hidden (COLLADA 1.4.1, <transparent opaque>): A_ONE by alpha,
   RGB_ONE by color; A_ZERO and RGB_ZERO the other way round; NONE hides all. */
color slot_opacity(color plain; string map; float ss, tt; float alpha, transparency;
                   string opaque;) {
    color Ot = 1;
    if (opaque == "A_ONE" || opaque == "A_ZERO") {
        float a = alpha;
        if (map != "")
            a = float texture(map[3], ss, tt);
        Ot = transparency * a;
    } else if (opaque == "RGB_ONE" || opaque == "RGB_ZERO") {
        Ot = transparency * slot_color(plain, map, ss, tt);
    }
    if (opaque == "A_ZERO" || opaque == "RGB_ZERO")
        Ot = 1 - Ot;
    return clamp(Ot, color(0), color(1));
}

/* Where rays are deep, either what is reflected or what lies behind the surface is followed. */
color mirrored(color reflective; float reflectivity; normal Nf; vector In; color opacity;) {
    color c = 0;
    if (reflectivity > 0) {
        c = reflectivity * reflective;
        if (c != color(0))
            c *= color trace(P, reflect(In, Nf), "weight", c * opacity, "opacity", opacity);
    }
    return c;
}

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
    color C = COLOR_OF(emission);
    Oi = slot_opacity(transparent, transparent_map, transparent_s, transparent_t,
                      transparent_alpha, transparency, opaque);
    C += mirrored(COLOR_OF(reflective), reflectivity, Nf, In, Oi);
    Ci = Oi * C;
}
