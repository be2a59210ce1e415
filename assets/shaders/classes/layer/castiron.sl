/* castiron.sl: a base layer: grey iron out of a sand mould, bright where hands have rubbed it.
   Parameters: pattern (a co-shader with value()), iron, bright, grain, Ks (as a shader by itself). */
class castiron(shader pattern = null; color iron = color(0.2, 0.2, 0.21);
               color bright = color(0.62, 0.6, 0.57); float grain = 26; float Ks = 1;) {
    public void paint(point Q; vector up; output color tint; output float gloss; output float rough;
                      output float metal; output float height) {
        float worn = 0.75 * float noise(2.2 * Q) + 0.25 * float noise(5 * Q);
        if (pattern != null) worn = pattern->value(1.4 * Q);
        float sand = float noise(grain * Q) + 0.5 * float noise(2.3 * grain * Q);
        worn = smoothstep(0.45, 0.75, worn);
        tint = mix(iron * mix(0.7, 1.2, sand), bright, 0.8 * worn);
        gloss = 0.35;
        rough = mix(0.42, 0.16, worn);
        metal = mix(0.55, 0.95, worn);
        height = 0.35 * sand * (1 - worn);
    }
    public void surface(output color Ci, Oi) {
        color tint = 0;
        float gloss = 0, rough = 1, metal = 0, height = 0;
        paint(transform("object", P), vector N, tint, gloss, rough, metal, height);
        normal Nf = faceforward(normalize(N), I);
        Ci = Oi * tint * ((1 - 0.6 * metal) * (ambient() + diffuse(Nf)) +
                          Ks * 2 * specular(Nf, -normalize(I), rough));
    }
}
