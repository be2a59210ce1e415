class disp_tiles_no_args(float tiles = 4, groove = 0.08, depth = 0.02; color tileColor = color(0.7, 0.75, 0.7), groutColor = color(0.3);)
{
    float inTile = 1;
    float ss = 0, tt = 0;
    void tilePattern() {
        ss = mod(s * tiles, 1);
        tt = mod(t * tiles, 1);
        inTile = smoothstep(0, groove, ss) * smoothstep(0, groove, 1 - ss) * smoothstep(0, groove, tt) * smoothstep(0, groove, 1 - tt);
    }
    public void begin() { tilePattern(); }
    public void displacement(output point P; output normal N) {
        vector n = normalize(N);
        P += n * depth * inTile;
        N = normalize(calculatenormal(P));
    }
    public void opacity(output color Oi) { Oi = Os; }
    public void surface(output color Ci, Oi) {
        Ci = Oi * mix(groutColor, tileColor, inTile) * (0.1 + diffuse(faceforward(N, I)));
    }
}
