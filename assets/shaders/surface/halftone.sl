/* halftone.sl: newspaper print: dots on a tilted screen, larger where it is dark; they stand still in
   the picture while the thing moves.
   Parameters: pitch (dots across the picture), angle in degrees, softness, ink and paper. */
surface halftone(float pitch = 46; float angle = 35; float softness = 0.12; float gain = 1;
                 color inkcolor = color(0.06, 0.05, 0.10); color papercolor = color(0.93, 0.89, 0.80);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    color light = 0.7 * diffuse(Nf) + ambient() + 0.8 * phong(Nf, V, 24);
    float tone = clamp(gain * comp(ctransform("YIQ", light), 0), 0, 1);
    point Pn = transform("NDC", P);
    float x = pitch * (xcomp(Pn) * cos(radians(angle)) - ycomp(Pn) * sin(radians(angle)));
    float y = pitch * (xcomp(Pn) * sin(radians(angle)) + ycomp(Pn) * cos(radians(angle)));
    float dot = 0.5 + 0.25 * (cos(2 * PI * x) + cos(2 * PI * y));
    float ink = smoothstep(tone - softness, tone + softness, 0.04 + 0.92 * dot);
    Oi = Os;
    Ci = Os * mix(papercolor, inkcolor, ink);
}
