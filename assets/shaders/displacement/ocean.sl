/* ocean.sl: wind waves on deep water: a sum of trains whose crests are sharp and whose troughs are
   wide; long waves run faster than short ones, as gravity has it.
   Parameters: height of the highest train, wavelength of the longest, trains, windangle in degrees,
   choppy 0..1, gravity (units a second squared), spread of the directions. */
displacement ocean(float height = 0.085; float wavelength = 1.9; float trains = 6;
                   float windangle = 28; float choppy = 0.6; float gravity = 9.81;
                   float spread = 42;) {
    point Q = transform("shader", P);
    float x = xcomp(Q);
    float y = ycomp(Q);
    float sum = 0;
    float width = sqrt(area(P));
    uniform float length_of = wavelength;
    uniform float tall = height;
    uniform float k;
    for (k = 0; k < trains; k += 1) {
        uniform float angle = radians(windangle + spread * (float cellnoise(k + 0.5) - 0.5) * 2);
        uniform float number = 2 * PI / length_of;
        uniform float speed = sqrt(gravity * number);
        float wobble = 1.2 * float noise(0.6 * x + 5 * k, 0.6 * y);
        float phase = number * (x * cos(angle) + y * sin(angle)) - speed * time + wobble;
        float wave = 0.5 + 0.5 * sin(phase);
        /* A power makes crests narrow. */
        float crest = 1 - pow(1 - wave, 1 / (1 + choppy));
        sum += tall * mix(2 * wave - 1, 2 * crest - 1.2, choppy) *
               (1 - smoothstep(0.25, 0.5, width / length_of));
        length_of *= 0.62;
        tall *= 0.52;
    }
    P += sum * normalize(N);
    N = calculatenormal(P);
}
