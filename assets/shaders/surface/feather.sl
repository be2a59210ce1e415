/* feather.sl: a bird's plumage: rows of feathers that overlap, each with a quill, barbs and an eye
   of colour near its tip.
   Parameters: around (feathers along s), rows (along t), the colours of barb, eye and rim, Ka Kd. */
surface feather(float Ka = 1; float Kd = 0.85; float Ks = 0.3; float roughness = 0.15;
                float around = 18; float rows = 12; color barbcolor = color(0.05, 0.20, 0.16);
                color eyecolor = color(0.08, 0.14, 0.50); color rimcolor = color(0.55, 0.36, 0.08);) {
    float y = rows * t;
    float seen = 0;
    float fx = 0, fy = 0, id = 0;
    uniform float k;
    /* Upper rows lie on lower ones: the first that covers the point hides the rest. */
    for (k = 2; k >= 0; k -= 1) {
        float row = floor(y) + k;
        float x = around * s + 0.5 * mod(row, 2);
        float px = x - floor(x) - 0.5;
        float py = (row + 0.4 - y) / 2.4;
        float half = 0.62 * sqrt(max(0, 1 - pow(abs(2 * py - 0.75), 3)));
        if (seen == 0 && py > 0 && py < 0.97 && abs(px) < half) {
            seen = 1;
            fx = px / max(half, 0.01);
            fy = py;
            id = float cellnoise(floor(x) + 0.5, row + 0.5);
            break;
        }
    }
    float barbs = 60 * fy - 26 * abs(fx);
    float w = abs(Du(60 * y / 2.4) * du) + abs(Dv(60 * y / 2.4) * dv);
    float comb = mix(0.5 + 0.5 * sin(2 * PI * barbs * 0.6), 0.5, smoothstep(0.3, 1.2, w));
    float quill = 1 - smoothstep(0.03, 0.07, abs(fx));
    float ex = fx * 0.8;
    float ey = (fy - 0.72) * 3;
    float eye = sqrt(ex * ex + ey * ey);
    color Ct = mix(barbcolor, rimcolor, 1 - smoothstep(0.55, 0.62, eye));
    Ct = mix(Ct, color(0.10, 0.42, 0.36), 1 - smoothstep(0.40, 0.46, eye));
    Ct = mix(Ct, eyecolor, 1 - smoothstep(0.24, 0.30, eye));
    Ct *= (0.65 + 0.5 * comb) * (0.8 + 0.4 * id);
    Ct = mix(Ct, color(0.45, 0.40, 0.30), 0.7 * quill * (1 - fy));
    Ct *= smoothstep(1.0, 0.82, abs(fx)) * 0.6 + 0.4;
    Ct *= mix(0.45, 1, seen) * (0.55 + 0.5 * fy);
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    float facing = clamp(Nf . V, 0, 1);
    color sheen = ctransform("hsv", "rgb", color(mod(0.38 + 0.3 * (1 - facing), 1), 0.8, 1));
    Oi = Os;
    Ci = Os * (Ct * (Ka * ambient() + Kd * diffuse(Nf)) * 1.4 +
               Ks * sheen * (0.4 + 0.6 * comb) * specular(Nf, V, 8 * roughness));
}
