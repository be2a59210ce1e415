// Matte that also reflects what light its surroundings send: colours bleed onto it.
surface bleeding(float Kd = 0.8; float Kbleed = 1; float samples = 64; float maxdist = 1e30;)
{
    normal Nf = faceforward(normalize(N), I);
    color around = indirectdiffuse(P, Nf, samples, "maxdist", maxdist);
    Oi = Os;
    Ci = Oi * Cs * Kd * (ambient() + diffuse(Nf) + Kbleed * around);
}
