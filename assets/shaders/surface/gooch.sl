/* gooch.sl: the shading of technical drawings: warm where light falls, cool where it does not, dark
   outlines, bright highlights; nothing is lost in black (after Gooch's cool-to-warm model).
   Parameters: objectcolor, cool and warm, how much of the object's colour each keeps, outline. */
surface gooch(color objectcolor = color(0.75, 0.28, 0.16); color coolcolor = color(0.05, 0.10, 0.45);
              color warmcolor = color(0.45, 0.40, 0.05); float coolkeep = 0.25; float warmkeep = 0.65;
              float outline = 0.24; float Ks = 0.6; float roughness = 0.03;) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    color total = 0;
    float lamps = 0;
    /* Shadows would break the slow turn from warm to cool: lamps are asked above the surface. */
    illuminance(P + 0.5 * Nf) {
        vector Ln = normalize(L);
        float warm = 0.5 + 0.5 * (Ln . Nf);
        float strength = max(max(Cl[0], Cl[1]), Cl[2]);
        total += strength * mix(coolcolor + coolkeep * objectcolor, warmcolor + warmkeep * objectcolor,
                                warm);
        lamps += strength;
    }
    if (lamps > 0)
        total /= lamps;
    else
        total = coolcolor + coolkeep * objectcolor;
    float facing = Nf . V;
    float w = abs(Du(facing) * du) + abs(Dv(facing) * dv);
    float ink = 1 - smoothstep(outline - 2 * w, outline, facing);
    color shine = specular(Nf, V, 8 * roughness);
    Oi = Os;
    Ci = Os * mix(total + Ks * shine, color(0.02, 0.02, 0.05), ink);
}
