/* gltf_pbr.sl: glTF 2.0's metallic-roughness material (specification, appendix B): a Lambert base
   under a GGX microfacet layer, lit by the scene's lights; metals have no base. Cl is taken as the
   irradiance over PI, RenderMan's custom, so the PI of both lobes is gone. With `mirrors` smooth
   surfaces show what stands around them, and the ambient light where nothing does. */

/* A texture with its coordinates: another set's where X_s and X_t are bound, then
   KHR_texture_transform in RSL's t upwards: s' = (X_ss X_st X_so) . (s, t, 1), t' likewise. */
#define MAP(X)                                                                                     \
    string X##_map = "";                                                                           \
    varying float X##_s = s;                                                                       \
    varying float X##_t = t;                                                                       \
    float X##_ss = 1;                                                                              \
    float X##_st = 0;                                                                              \
    float X##_so = 0;                                                                              \
    float X##_ts = 0;                                                                              \
    float X##_tt = 1;                                                                              \
    float X##_to = 0

#define S_OF(X) (X##_ss * X##_s + X##_st * X##_t + X##_so)
#define T_OF(X) (X##_ts * X##_s + X##_tt * X##_t + X##_to)

/* The tangent frame is that of the texture coordinates: T along growing s (or `given`, where the
   file has tangents), B to the side of growing t (or away from it: flip -1), both in the plane of
   N. */
normal mapped_normal(normal Nn; float ss, tt; color texel; float amount; vector given; float flip;) {
    float su = Du(ss), sv = Dv(ss), tu = Du(tt), tv = Dv(tt);
    float turn = su * tv - sv * tu;
    vector T = sign(turn) * (dPdu * tv - dPdv * tu);
    if (given . given > 0)
        T = given;
    T = T - (T . Nn) * vector Nn;
    normal result = Nn;
    if (turn != 0 && T . T > 0) {
        T = normalize(T);
        vector B = vector Nn ^ T;
        vector along = sign(turn) * (dPdv * su - dPdu * sv);
        if (B . along < 0)
            B = -B;
        B *= flip;
        float x = amount * (2 * comp(texel, 0) - 1);
        float y = amount * (2 * comp(texel, 1) - 1);
        float z = 2 * comp(texel, 2) - 1;
        result = normalize(normal(x * T + y * B + z * vector Nn));
    }
    return result;
}

/* What a microfacet layer reflects of light from everywhere: F0 x + y (Karis 2014, Physically based
   shading on mobile, his fit to the integral). */
color reflected_everywhere(color F0; float F90, roughness, NV;) {
    float rx = 1 - roughness, ry = 0.0425 - 0.0275 * roughness;
    float rz = 1.04 - 0.572 * roughness, rw = 0.022 * roughness - 0.04;
    float a = min(rx * rx, pow(2, -9.28 * NV)) * rx + ry;
    return F0 * (rz - 1.04 * a) + F90 * (rw + 1.04 * a);
}

surface gltf_pbr(
    color base_color = 1;
    float base_alpha = 1;
    MAP(base_color);
    float metallic = 1;
    float roughness = 1;
    MAP(metallic_roughness);
    float normal_scale = 1;
    MAP(normal);
    float occlusion_strength = 1;
    MAP(occlusion);
    color emissive = 0;
    MAP(emissive);
    float dielectric_F0 = 0.04;
    float specular = 1;
    color specular_color = 1;
    float specular_glossiness = 0;
    MAP(specular_glossiness);
    float mirrors = 0;
    string alpha_mode = "OPAQUE";
    float alpha_cutoff = 0.5;
    varying float vertex_alpha = 1;
    varying float tangent_u = 0;
    varying float tangent_v = 0;
    varying float tangent_flip = 1;) {
    color base = base_color * Cs;
    float a = base_alpha * vertex_alpha;
    if (base_color_map != "") {
        base *= color texture(base_color_map, S_OF(base_color), T_OF(base_color));
        if (alpha_mode != "OPAQUE")
            a *= float texture(base_color_map[3], S_OF(base_color), T_OF(base_color));
    }
    Oi = 1;
    if (alpha_mode == "MASK")
        Oi = a >= alpha_cutoff ? 1 : 0;
    if (alpha_mode == "BLEND")
        Oi = clamp(a, 0, 1);

    float metal = metallic, rough = roughness;
    if (metallic_roughness_map != "") {
        float ss = S_OF(metallic_roughness), tt = T_OF(metallic_roughness);
        metal *= float texture(metallic_roughness_map[2], ss, tt);
        rough *= float texture(metallic_roughness_map[1], ss, tt);
    }
    /* KHR_materials_pbrSpecularGlossiness: the specular color is F0, and takes its share of the base. */
    color shine = specular_color;
    if (specular_glossiness_map != "") {
        float ss = S_OF(specular_glossiness), tt = T_OF(specular_glossiness);
        shine *= color texture(specular_glossiness_map, ss, tt);
        rough = 1 - (1 - rough) * float texture(specular_glossiness_map[3], ss, tt);
    }
    if (specular_glossiness != 0)
        base *= max(1 - max(comp(shine, 0), comp(shine, 1), comp(shine, 2)), 0);
    rough = clamp(rough, 0, 1);
    metal = clamp(metal, 0, 1);
    float alpha2 = max(rough * rough, 0.002);
    alpha2 *= alpha2;

    normal Nf = normalize(N);
    if (normal_map != "")
        Nf = mapped_normal(Nf, normal_s, normal_t,
                           color texture(normal_map, S_OF(normal), T_OF(normal)), normal_scale,
                           tangent_u * dPdu + tangent_v * dPdv, sign(tangent_flip));
    if (Ng . I > 0)
        Nf = -Nf;
    vector V = -normalize(I);
    float NV = max(abs(Nf . V), 0.0001);

    /* KHR_materials_specular */
    color F0 = mix(specular * min(dielectric_F0 * shine, color(1)), base, metal);
    float F90 = mix(specular, 1, metal);
    color under = base * (1 - metal);
    color light = 0;
    /* How much of what the layer mirrors is found by rays; the rougher, the more light will do. */
    float clear = mirrors != 0 ? 1 - smoothstep(0.25, 0.5, rough) : 0;
    illuminance(P, Nf, PI / 2) {
        vector Ln = normalize(L);
        vector H = normalize(Ln + V);
        float NL = Nf . Ln, NH = clamp(Nf . H, 0, 1), VH = clamp(V . H, 0, 1);
        if (NL > 0) {
            float miss = pow(1 - VH, 5);
            color F = F0 + (F90 - F0) * miss;
            float d = NH * NH * (alpha2 - 1) + 1;
            float D = alpha2 / (d * d);
            /* Smith's shadowing of both ways over 4 NL NV (Heitz 2014). */
            float G = 0.5 / (NL * sqrt(NV * NV * (1 - alpha2) + alpha2) +
                             NV * sqrt(NL * NL * (1 - alpha2) + alpha2));
            /* A light without highlights is a broad one, which the layer mirrors as a glow. What
               other surfaces send is seen by the rays already. */
            float broad = 0, unseen = 1;
            string category = "";
            lightsource("__nonspecular", broad);
            lightsource("__category", category);
            if (category == "indirect")
                unseen = 1 - clear;
            color layer = F * D * G;
            if (broad > 0)
                layer = mix(layer, unseen * reflected_everywhere(F0, F90, rough, NV), broad);
            /* What lies around the scene is seen by the rays of smooth surfaces. */
            if (mirrors != 0) {
                float around_scene = 0;
                lightsource("__environment", around_scene);
                layer *= 1 - around_scene * clear;
            }
            light += Cl * NL * ((1 - F) * under + layer);
        }
    }
    color around = ambient();
    float open = 1;
    if (occlusion_map != "")
        open = mix(1, float texture(occlusion_map[0], S_OF(occlusion), T_OF(occlusion)),
                   occlusion_strength);
    light += open * around * under;
    color seen = open * around;
    if (clear > 0) {
        /* A cone about as wide as the lobe. */
        color hit = 0, mirrored = 0;
        gather("illuminance", P, reflect(-V, Nf), rough * rough, 1, "surface:Ci", hit)
            mirrored += hit;
        else
            mirrored += around;
        seen = mix(seen, mirrored, clear);
    }
    light += seen * reflected_everywhere(F0, F90, rough, NV);
    color glow = emissive;
    if (emissive_map != "")
        glow *= color texture(emissive_map, S_OF(emissive), T_OF(emissive));
    Ci = Oi * (light + glow);
}
