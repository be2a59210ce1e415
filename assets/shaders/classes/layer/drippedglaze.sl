/* drippedglaze.sl: a coat: glaze that was poured over the top and ran down in drips, thick at their
   ends. Below them the layer before stays as it is.
   Parameters: glaze, thin (the colour where it is thin), level (of the rim), run (how far), drips. */
class drippedglaze(color glaze = color(0.04, 0.2, 0.3); color thin = color(0.35, 0.62, 0.58);
                   float level = 0.1; float run = 0.75; float drips = 11;) {
    public void paint(point Q; vector up; output color tint; output float gloss; output float rough;
                      output float metal; output float height) {
        float around = atan(Q[1], Q[0]) / (2 * PI) * drips;
        float place = mod(around, 1), each = floor(around);
        float far = cellnoise(mod(each + drips, drips) + 0.5);
        float across = 1 - abs(2 * place - 1);
        float tongue = far * run * smoothstep(0.15, 0.85, across);
        float depth = Q[2] - level + tongue + 0.05 * float noise(5 * Q);
        float on = smoothstep(0, 0.025, depth);
        float bead = on * (1 - smoothstep(0.02, 0.16, depth));
        color run_color = mix(thin, glaze, smoothstep(0, 0.5, depth) * mix(0.75, 1, float noise(3 * Q)));
        tint = mix(tint, mix(run_color, glaze, 0.8 * bead), on);
        gloss = mix(gloss, 0.55, on);
        rough = mix(rough, 0.05, on);
        metal = mix(metal, 0, on);
        height = mix(height, 0.5 + 0.6 * bead + 0.05 * float noise(4 * Q), on);
    }
    public void surface(output color Ci, Oi) {
        color tint = color(0.62, 0.5, 0.4);
        float gloss = 0.05, rough = 0.5, metal = 0, height = 0;
        paint(transform("object", P), vector N, tint, gloss, rough, metal, height);
        normal Nf = faceforward(normalize(N), I);
        Ci = Oi * (tint * (ambient() + diffuse(Nf)) + gloss * specular(Nf, -normalize(I), rough));
    }
}
