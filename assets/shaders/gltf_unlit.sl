/* gltf_unlit.sl: KHR_materials_unlit: the base colour as it is. base_color_ss and the like are
   KHR_texture_transform, as in gltf_pbr.sl. */
surface gltf_unlit(
    color base_color = 1;
    float base_alpha = 1;
    string base_color_map = "";
    varying float base_color_s = s;
    varying float base_color_t = t;
    float base_color_ss = 1;
    float base_color_st = 0;
    float base_color_so = 0;
    float base_color_ts = 0;
    float base_color_tt = 1;
    float base_color_to = 0;
    string alpha_mode = "OPAQUE";
    float alpha_cutoff = 0.5;
    varying float vertex_alpha = 1;) {
    color base = base_color * Cs;
    float a = base_alpha * vertex_alpha;
    if (base_color_map != "") {
        float ss = base_color_ss * base_color_s + base_color_st * base_color_t + base_color_so;
        float tt = base_color_ts * base_color_s + base_color_tt * base_color_t + base_color_to;
        base *= color texture(base_color_map, ss, tt);
        if (alpha_mode != "OPAQUE")
            a *= float texture(base_color_map[3], ss, tt);
    }
    Oi = 1;
    if (alpha_mode == "MASK")
        Oi = a >= alpha_cutoff ? 1 : 0;
    if (alpha_mode == "BLEND")
        Oi = clamp(a, 0, 1);
    Ci = Oi * base;
}
