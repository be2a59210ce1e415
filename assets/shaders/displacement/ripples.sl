/* ripples.sl: rings that run over a pond from a few drops, each dying away.
   Parameters: amplitude, wavelength, speed, drops (how many), damping (per unit). */
displacement ripples(float amplitude = 0.075; float wavelength = 0.34; float speed = 0.6;
                     float drops = 3; float damping = 0.9;) {
    point Q = transform("shader", P);
    float height = 0;
    uniform float i = 0;
    while (i < drops) {
        uniform point where = point(3 * (float cellnoise(i + 0.5) - 0.5),
                                    3 * (float cellnoise(i + 20.5) - 0.5), 0);
        vector away = Q - where;
        setzcomp(away, 0);
        float r = length(away);
        float phase = r / wavelength - speed * time / wavelength + i * 0.37;
        height += exp(-damping * r) * cos(2 * PI * phase);
        i += 1;
    }
    P += amplitude * height * normalize(N);
    N = calculatenormal(P);
}
