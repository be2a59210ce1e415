/* backdrop.sl: the paper of a photographer's studio: a pale grey with thin lines, so that glass has
   something to bend. Parameters: the line's spacing and width in world units, the two colours. */
surface backdrop(float Ka = 1; float Kd = 0.62; float spacing = 0.5; float width = 0.014;
                 color papercolor = color(0.80, 0.79, 0.77);
                 color linecolor = color(0.30, 0.36, 0.42);) {
    float line(float x; float w) {
        float f = max(abs(Du(x) * du) + abs(Dv(x) * dv), 0.0001);
        float d = abs(mod(x + 0.5, 1) - 0.5);
        return clamp((w + 0.5 * f - d) / f, 0, 1) * min(1, 2 * w / f);
    }
    normal Nf = faceforward(normalize(N), I);
    point Q = transform("world", P) / spacing;
    float w = 0.5 * width / spacing;
    normal up = ntransform("world", Nf);
    float lines = line(xcomp(Q), w);
    if (zcomp(up) * zcomp(up) > 0.5 * (up . up))
        lines = max(lines, line(ycomp(Q), w));
    else
        lines = max(lines, line(zcomp(Q), w));
    Oi = Os;
    Ci = Os * mix(papercolor, linecolor, lines) * (Ka * ambient() + Kd * diffuse(Nf));
}
