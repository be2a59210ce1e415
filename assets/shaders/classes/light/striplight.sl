/* striplight.sl: a tube from one point to another. light() sets L from the nearest point of it.
   Parameters: intensity, lightcolor, from, to (in the light's space). */
class striplight(float intensity = 5; color lightcolor = color(0.75, 0.9, 1);
                 point from = point "shader" (-1.2, 0, 0); point to = point "shader" (1.2, 0, 0);) {
    public void light(output vector L; output color Cl) {
        vector tube = to - from;
        float place = clamp(((Ps - from) . tube) / (tube . tube), 0.02, 0.98);
        L = Ps - (from + place * tube);
        /* A line dims as the distance, not as its square, until it is far. */
        float d = length(L);
        Cl = intensity * lightcolor / (d * (1 + d) + 0.2) * mix(0.8, 1, sin(PI * place));
    }
}
