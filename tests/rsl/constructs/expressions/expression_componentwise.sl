// pow mod abs sign floor sqrt min max clamp step smoothstep mix of colors
surface expression_componentwise() {
    color c = color(0.2 + s, 0.5, 0.9 - t * 0.5);
    Ci = pow(c, 2) + pow(c, c) + mod(c * 3, 1) + abs(c - 0.5) + sign(c - 0.5) * 0.1;
    Ci += floor(c * 4) / 4 + ceil(c) * 0.1 + round(c) * 0.1 + sqrt(c);
    Ci += min(c, 0.5) + max(c, 0.25, Cs) + clamp(c, 0.1, 0.6) + clamp(c, color 0, color 1);
    Ci += step(0.5, c) * 0.1 + smoothstep(0, 1, c) + mix(Cs, c, 0.5) + mix(Cs, c, c);
    vector v = abs(vector N) + min(vector I, vector N) + mix(vector I, vector N, 0.5);
    Ci += color(v) * 0.01 + color(mod(P, 1)) * 0.01;
    Ci *= 0.05;
}
