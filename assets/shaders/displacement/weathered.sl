/* weathered.sl: soft rock worn by wind: hard and soft layers, ridged by a fractal whose roughness
   grows with height (a multifractal).
   Parameters: Km, scale, lacunarity, gain, octaves, layers (per unit of z). */
float ridged(point p; uniform float octaves, lacunarity, gain) {
    float result = 0, weight = 1, frequency = 1, amplitude = 0.5;
    uniform float i;
    for (i = 0; i < octaves; i += 1) {
        float signal = 1 - abs(2 * float noise(frequency * p) - 1);
        signal *= signal * weight;
        weight = clamp(signal * gain, 0, 1);
        result += signal * amplitude;
        frequency *= lacunarity;
        amplitude /= lacunarity;
    }
    return result;
}

displacement weathered(float Km = 0.22; float scale = 1.1; float lacunarity = 2.1; float gain = 1.8;
                       float octaves = 6; float layers = 3.5;) {
    point Q = scale * transform("object", P);
    float bend = 0.4 * float noise(1.2 * Q);
    float strata = float noise(layers * (zcomp(Q) + bend) * 2);
    strata = smoothstep(0.3, 0.7, strata);
    point Qflat = point(xcomp(Q), ycomp(Q), 1.8 * zcomp(Q));
    float height = ridged(Qflat, octaves, lacunarity, gain);
    P += Km * (height - 0.6 + 0.35 * strata) * normalize(N);
    N = calculatenormal(P);
}
