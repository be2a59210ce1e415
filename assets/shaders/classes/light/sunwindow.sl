/* sunwindow.sl: the sun through a window: panes, bars, and leaves that move outside.
   Parameters: intensity, sun, panes, bar, leaves (0 to 1). */
class sunwindow(float intensity = 1.6; color sun = color(1, 0.9, 0.72); float panes = 3;
                        float bar = 0.08; float leaves = 0.7; float size = 1.5;) {
    float pane(float x) {
        float place = mod(x, 1);
        return smoothstep(bar, 1.6 * bar, place) * (1 - smoothstep(1 - 1.6 * bar, 1 - bar, place));
    }
    float foliage(float x, y) {
        float k, shade = 0;
        for (k = 1; k <= 3; k += 1)
            shade = max(shade, noise(3.1 * k * x + 4 * k, 2.3 * k * y + 0.1 * time));
        return mix(1, smoothstep(0.72, 0.6, shade), leaves);
    }
    public void light(output vector L; output color Cl) {
        solar(vector "shader" (0, 0, 1), 0) {
            point Q = transform("shader", Ps);
            float x = Q[0] / size * panes / 2, y = Q[1] / size * panes / 2;
            float half = panes / 2;
            float inside = abs(x) < half && abs(y) < half ? 1 : 0;
            Cl = intensity * sun * inside * pane(x + half) * pane(y + half) * foliage(Q[0], Q[1]);
        }
    }
}
