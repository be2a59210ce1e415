/* matteshadow.sl: a shadow catcher: invisible where it is lit, dark where it is not; to lay a
   rendered thing's shadow on a photograph. Each lamp's transmission is asked for.
   Parameters: density, shadowcolor, showlit (how much the lit part is seen, for trying out). */
surface matteshadow(float density = 0.85; color shadowcolor = color(0.02, 0.02, 0.06);
                    float showlit = 0.25;) {
    normal Nf = faceforward(normalize(N), I);
    color lit = 0;
    color all = 0;
    illuminance(P, Nf, PI / 2) {
        float c = normalize(L) . Nf;
        color through = transmission(P, P + L);
        float free = visibility(P, P + L);
        lit += c * through * mix(1, free, 0.5);
        all += c * color(1, 1, 1);
    }
    float dark = 0;
    if (comp(all, 1) > 0)
        dark = 1 - comp(lit, 1) / comp(all, 1);
    dark = clamp(density * dark, 0, 1);
    Oi = max(dark, showlit);
    Ci = mix(showlit * color(0.9, 0.9, 0.85), shadowcolor * dark, dark);
}
