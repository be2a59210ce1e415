/* truchet.sl: quarter circles that join at random into one winding ribbon.
   Parameters: scale, width, ribbon, ground. */
class truchet(float scale = 14; float width = 0.16; color ribbon = color(0.9, 0.78, 0.5);
              color ground = color(0.05, 0.13, 0.2);) {
    varying float edge = 0;

    public void begin() {
        float ss = 2 * scale * s, tt = scale * t;
        float x = mod(ss, 1), y = mod(tt, 1);
        if (cellnoise(floor(ss) + 0.5, floor(tt) + 0.5) > 0.5) x = 1 - x;
        float near = min(sqrt(x * x + y * y), sqrt((1 - x) * (1 - x) + (1 - y) * (1 - y)));
        edge = abs(near - 0.5);
    }
    public void displacement(output point P; output normal N) {
        float h = sqrt(max(0, 1 - edge * edge / (width * width)));
        P += 0.02 * h * normalize(N);
        N = calculatenormal(P);
    }
    public void surface(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        float on = 1 - smoothstep(0.94 * width, width, edge);
        float seam = smoothstep(0.5 * width, 0.55 * width, edge) * (1 - smoothstep(0.65 * width, 0.7 * width, edge));
        color base = mix(ground, ribbon * (1 - 0.5 * seam), on);
        Ci = Oi * (base * (ambient() + diffuse(Nf)) + mix(0.1, 0.45, on) * specular(Nf, -normalize(I), 0.08));
    }
}
