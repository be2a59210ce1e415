/* plasterroom.sl: chalky plaster that takes on the colours around it: light that other things throw
   back, gathered over the hemisphere.
   Parameters: samples, maxdist, Ka Kd, Kbounce, surface_color. */
surface plasterroom(float Ka = 0.3; float Kd = 0.7; float Kbounce = 0.9; float samples = 24;
                    float maxdist = 6; float unevenness = 0.01;
                    color surface_color = color(0.86, 0.83, 0.77);) {
    point Q = transform("object", P);
    float rough = float noise(7 * Q) + 0.4 * float noise(19 * Q);
    normal Nn = calculatenormal(P + unevenness * rough * normalize(N));
    normal Nf = faceforward(normalize(Nn), I);
    color bounced = indirectdiffuse(P, faceforward(normalize(N), I), samples, "maxdist", maxdist);
    Oi = Os;
    Ci = Os * surface_color * (Ka * ambient() + Kd * diffuse(Nf) + Kbounce * bounced);
}
