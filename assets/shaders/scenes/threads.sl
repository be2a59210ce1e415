/* threads.sl: the screw thread of a bulb's base: a sine along the cylinder (t) that is shifted by
   the place around it (s), faded out at both ends so that the openings stay round. */
displacement threads(float freq = 5; float amplitude = 0.1; float phase = 0; float offset = 0;) {
    float height = (sin(2 * PI * (t * freq + s + phase)) + offset) * amplitude;
    if (t > 0.95)
        height *= (1 - t) / 0.05;
    else if (t < 0.05)
        height *= t / 0.05;
    P += height * normalize(N);
    N = calculatenormal(P);
}
