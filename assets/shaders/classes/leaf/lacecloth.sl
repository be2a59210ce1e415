/* lacecloth.sl: lace: threads of opacity(), shaded where they are.
   Parameters: repeats, thread, tint. */
class lacecloth(float repeats = 4; float thread = 0.09; color tint = color(0.85, 0.82, 0.76);) {
    varying float cord = 0;  // 1 in a thread's middle, below 0 beside it

    void line(float away, width) { cord = max(cord, 1 - abs(away) / width); }
    public void begin() {
        float x = 2 * mod(repeats * s, 1) - 1, y = 2 * mod(repeats * t, 1) - 1;
        float r = sqrt(x * x + y * y), angle = atan(y, x);
        cord = -1;
        line(r - 0.9, thread);
        line(r - (0.55 + 0.16 * cos(8 * angle)), thread);
        line(r - 0.2, thread);
        line(mod(8 * angle / PI + 0.5, 1) - 0.5 + 4 * step(0.9, r) + 4 * step(r, 0.7), 1.6 * thread);
        line(abs(x) + abs(y) - 1.55, thread);
        float netx = mod(14 * repeats * s, 1) - 0.5, nety = mod(14 * repeats * t, 1) - 0.5;
        if (r > 0.9) line(min(abs(netx), abs(nety)), 0.16);
        line(min(s, 1 - s) - 0.02, 0.03);
        line(min(t, 1 - t) - 0.02, 0.03);
    }
    public void opacity(output color Oi) { Oi = cord > 0 ? 1 : 0; }
    public void surface(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        float twist = 0.5 + 0.5 * sin(400 * (s + t));
        color base = tint * mix(0.75, 1.1, sqrt(max(0, cord))) * mix(0.85, 1, twist);
        Ci = Oi * base * (ambient() + diffuse(Nf) + 0.35 * diffuse(-Nf));
    }
}
