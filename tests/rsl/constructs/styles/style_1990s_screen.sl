// opacity by a pattern, early Ci
surface style_1990s_screen(float density = .25, frequency = 20, Kd = .5, Ka = .2) {
    varying point V; varying point Nf;
    if (mod(s * frequency, 1) < density || mod(t * frequency, 1) < density) Oi = 1.0;
    else Oi = 0.0;
    if (comp(Oi, 0) > 0 || comp(Oi, 1) > 0) { Nf = faceforward(N, I); V = normalize(-I);
        Ci = Oi * Cs * (Ka * ambient() + Kd * diffuse(normalize(Nf))); } else Ci = 0;
}
