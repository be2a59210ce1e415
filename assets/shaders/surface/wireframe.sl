/* wireframe.sl: shows the parameter lines of a surface as ink on paper, of constant width in the
   picture, with every fifth line stronger.
   Parameters: freq (lines along s; half along t), width in pixels, hollow (1: nothing between). */
surface wireframe(float freq = 40; float width = 1.1; float hollow = 0; float shade = 0.6;
                  color linecolor = color(0.05, 0.12, 0.30);
                  color papercolor = color(0.88, 0.90, 0.92);) {
    float line(float x; float pixels;) {
        float w = max(abs(Du(x) * du) + abs(Dv(x) * dv), 0.00001);
        float d = abs(x - round(x)) / w;
        return clamp(0.5 * pixels + 0.5 - d, 0, 1) * min(1, 0.5 / w);
    }
    float x = freq * s;
    float y = freq * t / 2;
    float ink = 0.55 * max(line(x, width), line(y, width));
    ink = max(ink, max(line(x / 5, 2 * width), line(y / 5, 2 * width)));
    normal Nf = faceforward(normalize(N), I);
    color paper = papercolor * mix(color(1, 1, 1), 0.35 + 0.65 * diffuse(Nf) + 0.3 * ambient(), shade);
    float solid = mix(1, ink, hollow);
    Oi = Os * solid;
    Ci = Oi * mix(paper, linecolor, ink);
}
