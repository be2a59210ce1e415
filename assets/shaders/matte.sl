/* matte.sl: Lambert reflection. */
surface matte(float Ka = 1; float Kd = 1; color surface_color = 1;) {
    normal Nf = faceforward(normalize(N), I);
    Oi = Os;
    Ci = Os * Cs * surface_color * (Ka * ambient() + Kd * diffuse(Nf));
}
