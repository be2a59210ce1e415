/* weave.sl: a basket of flat willow strips, over and under, with dark holes between; open == 1 lets
   one look through the holes.
   Parameters: freq (strips across s; half as many along t), width of a strip 0..1, open, the two
   strips' colours, Ka Kd Ks roughness. */
surface weave(float Ka = 1; float Kd = 0.85; float Ks = 0.25; float roughness = 0.15;
              float freq = 26; float width = 0.84; float open = 0;
              color warpcolor = color(0.55, 0.36, 0.15); color weftcolor = color(0.42, 0.24, 0.09);
              color holecolor = color(0.02, 0.012, 0.006);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    float x = freq * s;
    float y = freq * t / 2;
    float w = max(abs(Du(x) * du) + abs(Dv(x) * dv), abs(Du(y) * du) + abs(Dv(y) * dv));
    float column = floor(x);
    float row = floor(y);
    float fx = x - column - 0.5;
    float fy = y - row - 0.5;
    float over = mod(column + row, 2);
    /* The strip on top, and how far this point is from its middle and along its arch. */
    float side = abs(fx);
    float arch = fy;
    float other = abs(fy);
    if (over >= 1) {
        side = abs(fy);
        arch = fx;
        other = abs(fx);
    }
    float half = 0.5 * width;
    float top = 1 - smoothstep(half - w, half + w, side);
    float below = 1 - smoothstep(half - w, half + w, other);
    float shade = 1 - 1.6 * arch * arch;
    float id = column;
    if (over >= 1)
        id = row + 200.5;
    float fibre = float noise(point(side * 26 + 3 * id, 2.2 * (x + y), id));
    color strip = mix(warpcolor, weftcolor, over >= 1 ? 1 : 0);
    strip *= 0.75 + 0.35 * float cellnoise(id + 0.5) + 0.3 * (fibre - 0.5);
    color under = mix(weftcolor, warpcolor, over >= 1 ? 1 : 0) * 0.3;
    color Ct = mix(mix(holecolor, under, below), strip * shade, top);
    color mean = mix(warpcolor, weftcolor, 0.5) * 0.72;
    Ct = mix(Ct, mean, smoothstep(0.5, 1.2, w));

    float solid = 1 - open * (1 - top) * (1 - below);
    Oi = Os * solid;
    Ci = Oi * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               Ks * top * shade * specular(Nf, V, 8 * roughness));
}
