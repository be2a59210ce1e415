/* contourmap.sl: a map of hills by height: colours of a resizable array, lines between its steps.
   Parameters: tints (from the sea up), hills, line. */
class contourmap(uniform color tints[] = {color(0.2, 0.42, 0.6), color(0.45, 0.66, 0.75),
                                          color(0.52, 0.66, 0.38), color(0.76, 0.74, 0.46),
                                          color(0.66, 0.48, 0.3), color(0.95, 0.94, 0.92)};
                 float hills = 1.3; float line = 0.06;) {
    uniform float steps[];
    varying float height = 0;

    public void construct() {
        uniform float k, n = arraylength(tints);
        resize(steps, n);
        for (k = 0; k < n; k += 1) steps[k] = mix(0.3, 0.68, k / (n - 1));
    }
    public void begin() {
        point Q = hills * transform("object", P);
        float k, weight = 0.5;
        height = 0;
        for (k = 0; k < 6; k += 1) {
            height += weight * float noise(Q);
            Q = 2.1 * Q + vector(5, 3, 1);
            weight *= 0.48;
        }
    }
    public void displacement(output point P; output normal N) {
        P += 0.35 * max(height, steps[1]) * normalize(N);
        N = calculatenormal(P);
    }
    public void surface(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        color base = tints[0];
        float k;
        for (k = 1; k < arraylength(tints); k += 1)
            base = mix(base, tints[k], smoothstep(steps[k] - 0.012, steps[k] + 0.012, height));
        float contour = abs(mod(50 * height, 1) - 0.5), width = line + 50 * (abs(Du(height) * du) + abs(Dv(height) * dv));
        base *= mix(0.55, 1, height > steps[1] ? smoothstep(0.5 * width, width, contour) : 1);
        Ci = Oi * base * (ambient() + diffuse(Nf));
    }
}
