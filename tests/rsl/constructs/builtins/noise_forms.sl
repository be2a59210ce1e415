// noise of 1 to 4 dimensions, every result, chosen by context
surface noise_forms() {
    float a = noise(s), b = noise(s, t), c = noise(P), d = noise(P, time);
    color e = noise(P * 2), f = color noise(s, t);
    point g = point noise(P), h = P + noise(P);
    vector i = vector noise(P) - 0.5;
    float j = float noise(P) + 2 * noise(s * 4) - 1;
    Ci = e * a + f * b + color g * c + color h * 0.01 + color i * d + j * 0.1 + 0.1 * noise(P);
    if (noise(P) > 0.5) Ci *= 0.9;
}
