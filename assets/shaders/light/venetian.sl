/* venetian.sl: evening sun between the slats of a blind: parallel stripes, a little crooked.
   Parameters: intensity, lightcolor, slats (per unit across the beam), open (share that lets light
   through), softness, tilt of the stripes in degrees. */
light venetian(float intensity = 1.25; color lightcolor = color(1, 0.72, 0.40);
               color shadecolor = color(0.03, 0.04, 0.08); float slats = 3.1; float open = 0.55;
               float softness = 0.07; float tilt = 12;) {
    uniform vector axis = vector "shader" (0, 0, 1);
    /* A matrix puts the point into the space of the blind: turned about the beam. */
    uniform matrix blind = rotate(matrix 1, radians(tilt), vector(0, 0, 1));
    point Q = transform(blind, transform("shader", Ps));
    float y = slats * ycomp(Q) + 0.08 * (float noise(0.9 * xcomp(Q), 3 * floor(slats * ycomp(Q))) - 0.5);
    float phase = mod(y, 1);
    float gap = smoothstep(0, softness, phase) * (1 - smoothstep(open, open + softness, phase));
    solar(axis, 0) {
        Cl = intensity * mix(shadecolor, lightcolor, gap);
    }
}
