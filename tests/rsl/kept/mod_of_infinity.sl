// A finite number modulo infinity is itself, or beyond float where the signs differ.
// world 5
surface fuzz() {
    float k = 1e38 * 1e38 * (1 + s);
    Ci = color(mod(1, k), mod(-1, k), mod(-0.5, -k));
    Oi = mod(color 0.75, specularbrdf(vector 1, normal 1, vector 0, 0));
}
