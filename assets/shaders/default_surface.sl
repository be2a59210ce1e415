/* default_surface.sl: what has no material: a light grey that shows its form. */
surface default_surface(color diffuse_color = color(0.8, 0.8, 0.8);) {
    normal Nf = faceforward(normalize(N), I);
    Oi = Os;
    Ci = Os * Cs * diffuse_color * (ambient() + diffuse(Nf));
}
