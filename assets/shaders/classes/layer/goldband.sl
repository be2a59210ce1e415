/* goldband.sl: a decal: a band of painted gold waves around the belly, worn a little.
   Parameters: pattern (a co-shader with value()), gold, ink, middle, width, waves. */
class goldband(shader pattern = null; color gold = color(0.95, 0.68, 0.24);
               color ink = color(0.07, 0.05, 0.1); float middle = 0.05; float width = 0.24;
               float waves = 14;) {
    public void paint(point Q; vector up; output color tint; output float gloss; output float rough;
                      output float metal; output float height) {
        float around = atan(Q[1], Q[0]) * waves;
        float y = (Q[2] - middle) / width;
        float lines = smoothstep(0.86, 0.9, abs(y)) * (1 - smoothstep(0.98, 1.02, abs(y)));
        float wave = abs(y - 0.4 * sin(around)), second = abs(y + 0.4 * sin(around));
        float strokes = max(1 - smoothstep(0.1, 0.15, wave), 1 - smoothstep(0.1, 0.15, second));
        float dots = 1 - smoothstep(0.1, 0.14, sqrt(y * y + pow(sin(0.5 * around + PI / 2), 2) * 0.3));
        float worn = float noise(9 * Q);
        if (pattern != null) worn = pattern->value(4 * Q);
        float keeps = 1 - 0.85 * smoothstep(0.62, 0.72, worn);
        float band = (1 - smoothstep(0.98, 1.02, abs(y))) * keeps;
        float on = max(lines, (1 - smoothstep(0.84, 0.86, abs(y))) * max(strokes, dots)) * keeps;
        tint = mix(tint, ink, 0.8 * band);
        tint = mix(tint, gold, on);
        gloss = mix(gloss, 0.6, on);
        rough = mix(rough, 0.13, on);
        metal = mix(metal, 0.9, on);
        height += 0.12 * on;
    }
    public void surface(output color Ci, Oi) {
        color tint = color(0.85, 0.83, 0.78);
        float gloss = 0.3, rough = 0.1, metal = 0, height = 0;
        paint(transform("object", P), vector N, tint, gloss, rough, metal, height);
        normal Nf = faceforward(normalize(N), I);
        color shine = mix(color gloss, tint, metal);
        Ci = Oi * (tint * (1 - 0.5 * metal) * (ambient() + diffuse(Nf)) +
                   1.5 * shine * specular(Nf, -normalize(I), rough));
    }
}
