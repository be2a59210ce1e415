/* dustfall.sl: dirt: dust that lies on what faces the sky and in hollows, by the height that the
   layers before have left.
   Parameters: pattern (a co-shader with value()), dust, amount (0 to 1). */
class dustfall(shader pattern = null; color dust = color(0.5, 0.42, 0.32); float amount = 0.55;) {
    public void paint(point Q; vector up; output color tint; output float gloss; output float rough;
                      output float metal; output float height) {
        float cloud = float noise(6 * Q);
        if (pattern != null) cloud = pattern->value(3 * Q);
        float lies = 0.75 * up[2] + 0.5 * (cloud - 0.5) - 0.35 * height + 0.25 * float noise(40 * Q);
        float on = amount * smoothstep(0.25, 0.75, lies);
        tint = mix(tint, dust * mix(0.85, 1.1, cloud), on);
        gloss *= 1 - 0.9 * on;
        rough = mix(rough, 0.8, on);
        metal *= 1 - on;
        height += 0.06 * on * float noise(60 * Q);
    }
    public void surface(output color Ci, Oi) {
        color tint = color(0.16, 0.15, 0.17);
        float gloss = 0.5, rough = 0.08, metal = 0, height = 0;
        paint(transform("object", P), vtransform("world", vector normalize(N)), tint, gloss, rough,
              metal, height);
        normal Nf = faceforward(normalize(N), I);
        Ci = Oi * (tint * (ambient() + diffuse(Nf)) + gloss * specular(Nf, -normalize(I), rough));
    }
}
