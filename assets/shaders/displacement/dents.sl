/* dents.sl: a thing that was knocked about: round hollows of many sizes, as turbulence to a power.
   Parameters: Km (depth), scale (per unit), power (higher: rarer and sharper dents), octaves. */
displacement dents(float Km = 0.5; float scale = 1.6; float power = 3; float octaves = 5;) {
    point Q = scale * transform("shader", P);
    float magnitude = 0;
    float size = 1;
    uniform float i;
    for (i = 0; i < octaves; i += 1) {
        magnitude += abs(0.5 - float noise(Q * size)) / size;
        size *= 2;
    }
    P -= normalize(N) * Km * pow(clamp(1.3 * magnitude, 0, 1), power);
    N = calculatenormal(P);
}
