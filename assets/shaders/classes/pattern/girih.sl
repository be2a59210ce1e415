/* girih.sl: stars of ten points in straps, from lines of five directions. The directions are a
   table that construct() makes once.
   Parameters: scale, strap, ground, star, band. */
class girih(float scale = 7; float strap = 0.05; color ground = color(0.02, 0.2, 0.3);
            color star = color(0.75, 0.6, 0.25); color band = color(0.85, 0.84, 0.78);) {
    uniform float across[5], along[5];
    varying float near = 1, parity = 0;

    public void construct() {
        uniform float k;
        for (k = 0; k < 5; k += 1) {
            across[k] = cos(k * PI / 5);
            along[k] = sin(k * PI / 5);
        }
    }
    public void begin() {
        float x = 2 * scale * s, y = scale * t, k;
        near = 1;
        parity = 0;
        for (k = 0; k < 5; k += 1) {
            float place = x * across[k] + y * along[k] + 0.5;
            near = min(near, abs(mod(place, 1) - 0.5));
            parity += floor(place + 0.5);
        }
    }
    public void displacement(output point P; output normal N) {
        P += 0.012 * (1 - smoothstep(strap, 1.5 * strap, near)) * normalize(N);
        N = calculatenormal(P);
    }
    public void surface(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        color base = mod(parity, 2) < 0.5 ? ground : star;
        base = mix(band, base, smoothstep(strap, 1.2 * strap, near));
        Ci = Oi * (base * (ambient() + diffuse(Nf)) + 0.3 * specular(Nf, -normalize(I), 0.06));
    }
}
