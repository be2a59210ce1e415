/* shinglesroof.sl: clay roof tiles in rows, each a half pipe that overlaps the next, some mossy.
   Parameters: columns, rows, tilecolor, spread of the firing, moss, Ka Kd. */
surface shinglesroof(float Ka = 1; float Kd = 0.9; float columns = 22; float rows = 14;
                     float spread = 0.5; float moss = 0.35; color tilecolor = color(0.55, 0.20, 0.09);) {
    float x = columns * s;
    float y = rows * t;
    float column = floor(x);
    float row = floor(y);
    float fx = 2 * (x - column) - 1;
    float fy = y - row;
    float own = float cellnoise(column + 0.5, row + 0.5);
    /* A pipe's arch, thicker at its lower end. */
    float arch = sqrt(max(0, 1 - fx * fx));
    float lip = 1 - smoothstep(0, 0.06, fy);
    float height = 0.55 * arch + 0.35 * (1 - fy);
    normal Nn = calculatenormal(P + 0.05 * height * normalize(N));
    normal Nf = faceforward(normalize(Nn), I);
    color Ct = tilecolor * (1 - 0.5 * spread + spread * own);
    Ct = mix(Ct, Ct * color(0.8, 0.65, 0.55), float noise(13 * s * columns / 4, 9 * t * rows / 4));
    float green = moss * smoothstep(0.5, 0.7, float noise(0.6 * x, 0.6 * y)) * smoothstep(0.4, 0.9, 1 - fy);
    Ct = mix(Ct, color(0.16, 0.20, 0.05), green);
    Ct *= mix(0.35, 1, smoothstep(0, 0.35, arch)) * mix(1, 0.45, smoothstep(0.86, 0.99, fy)) * (1 - 0.25 * lip);
    Oi = Os;
    Ci = Os * Ct * (Ka * ambient() + Kd * diffuse(Nf));
}
