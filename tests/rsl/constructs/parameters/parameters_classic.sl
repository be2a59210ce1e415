// parameters separated by ';' and ','; default expressions
surface parameters_classic(float Ka = 1, Kd = .5; float Ks = 0.25 * 2, roughness = 1 / 10;
                           color specularcolor = 1; string note = "";) {
    normal Nf = faceforward(normalize(N), I);
    Oi = Os;
    Ci = Os * (Cs * (Ka * ambient() + Kd * diffuse(Nf)) +
               specularcolor * Ks * specular(Nf, -normalize(I), roughness));
}
