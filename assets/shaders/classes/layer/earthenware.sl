/* earthenware.sl: a base layer: fired clay with grog in it, turned on a wheel.
   Parameters: pattern (a co-shader with value()), clay, dark, grooves (a unit), Kd (as a shader by itself). */
class earthenware(shader pattern = null; color clay = color(0.6, 0.27, 0.13);
                  color dark = color(0.33, 0.12, 0.06); float grooves = 9; float Kd = 0.9;) {
    public void paint(point Q; vector up; output color tint; output float gloss; output float rough;
                      output float metal; output float height) {
        float cloud = 0.5;
        if (pattern != null) cloud = pattern->value(2 * Q);
        float ring = sin(2 * PI * grooves * Q[2] + 2 * cloud);
        float grog = smoothstep(0.74, 0.8, float noise(34 * Q));
        tint = mix(dark, clay, 0.35 + 0.5 * cloud + 0.1 * ring);
        tint = mix(tint, color(0.85, 0.72, 0.55), 0.5 * grog);
        gloss = 0.08;
        rough = 0.6;
        metal = 0;
        height = 0.12 * ring + 0.2 * cloud + 0.15 * grog;
    }
    public void surface(output color Ci, Oi) {
        color tint = 0;
        float gloss = 0, rough = 1, metal = 0, height = 0;
        paint(transform("object", P), vector N, tint, gloss, rough, metal, height);
        normal Nf = faceforward(normalize(N), I);
        Ci = Oi * tint * Kd * (ambient() + diffuse(Nf)) + gloss * specular(Nf, -normalize(I), rough);
    }
}
