displacement threads(float freq = 5.0, amplitude = 0.1, phase = 0.0, offset = 0.0;) {
    point nDel = normalize(N);
    float scale = (sin(PI * 2 * (v * freq + u + phase)) + offset) * amplitude;
    if (v > 0.95)
        scale = scale * (1.0 - v) / .05;
    else if (v < 0.05)
        scale = scale * v / .05;
    nDel = nDel * scale;
    P = P + nDel;
    N = calculatenormal(P);
}
