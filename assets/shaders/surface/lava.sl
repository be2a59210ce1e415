/* lava.sl: cooling lava: a black crust that cracked, and glowing rock in the cracks, as hot as its
   colour says.
   Parameters: scale (plates per unit), heat, crackwidth, pulse (glow's change with time), crustcolor. */
surface lava(float Ka = 1; float Kd = 0.7; float scale = 2.4; float heat = 1.5;
             float crackwidth = 0.22; float pulse = 0.25; color crustcolor = color(0.045, 0.038, 0.036);) {
    point Q = scale * transform("object", P);
    Q += 0.7 * (vector noise(1.1 * Q) - vector(0.5, 0.5, 0.5));
    point corner = point(floor(xcomp(Q)), floor(ycomp(Q)), floor(zcomp(Q)));
    float f1 = 9, f2 = 9;
    uniform float n;
    for (n = 0; n < 27; n += 1) {
        point cell = corner + vector(mod(n, 3) - 0.5, mod(floor(n / 3), 3) - 0.5, floor(n / 9) - 0.5);
        float d = distance(Q, cell + 0.9 * (vector cellnoise(cell) - vector(0.5, 0.5, 0.5)));
        f2 = min(f2, max(f1, d));
        f1 = min(f1, d);
    }
    float crack = 1 - smoothstep(0, crackwidth, f2 - f1);
    float rough = float noise(9 * Q) + 0.5 * float noise(21 * Q);
    normal Nn = calculatenormal(P - 0.05 / scale * (3 * crack - rough) * normalize(N));
    normal Nf = faceforward(normalize(Nn), I);
    float hot = heat * pow(crack, 1.5) *
                (0.65 + pulse * sin(2 * PI * (0.3 * time + float noise(0.4 * Q)))) *
                (0.55 + 0.7 * float noise(0.9 * Q + vector(0, 0, 0.1 * time)));
    /* Dark red, orange, yellow, white: a ramp of heat with B-spline smoothness. */
    color glow = color spline("bspline", clamp(hot, 0, 1), color(0, 0, 0), color(0, 0, 0),
                              color(0.32, 0.012, 0), color(1.1, 0.16, 0.01), color(1.6, 0.62, 0.08),
                              color(1.9, 1.3, 0.5), color(2, 1.8, 1.1));
    Oi = Os;
    Ci = Os * (crustcolor * (0.5 + 0.7 * rough) * (Ka * ambient() + Kd * diffuse(Nf)) + glow +
               0.05 * specular(Nf, -normalize(I), 1.6) * (1 - crack));
}
