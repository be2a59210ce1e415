/* plaster.sl: a painted wall: matt, brushed unevenly. */
surface plaster(float Ka = 1; float Kd = 0.9; float unevenness = 0.12;
                color surface_color = color(0.05, 0.16, 0.17);) {
    normal Nf = faceforward(normalize(N), I);
    point Pwall = transform("world", P);
    float cloud = float noise(1.3 * Pwall) + 0.5 * float noise(3.1 * Pwall);
    float brush = float noise(point(45 * xcomp(Pwall), 45 * ycomp(Pwall), 9 * zcomp(Pwall)));
    float value = 1 + unevenness * (cloud - 0.75 + 0.5 * (brush - 0.5));
    Oi = Os;
    Ci = Os * Cs * surface_color * value * (Ka * ambient() + Kd * diffuse(Nf));
}
