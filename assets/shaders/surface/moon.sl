/* moon.sl: a dusty moon: seas, bright rays from young craters, and the flat look of dust, which
   throws light back to where it came from (Oren and Nayar's rough matte).
   Parameters: sigma (roughness of the dust, radians), scale, relief, the three colours, Ka Kd. */
surface moon(float Ka = 0.4; float Kd = 1.15; float sigma = 0.6; float scale = 1.3;
             float relief = 0.03; color highland = color(0.62, 0.60, 0.57);
             color seacolor = color(0.24, 0.235, 0.23); color raycolor = color(0.82, 0.80, 0.77);) {
    /* Rough matte reflection of one lamp. */
    color dust(normal Nn; vector V; vector Ln; color light; uniform float rough) {
        uniform float s2 = rough * rough;
        uniform float A = 1 - 0.5 * s2 / (s2 + 0.33);
        uniform float B = 0.45 * s2 / (s2 + 0.09);
        float cosl = Ln . Nn;
        float cosv = V . Nn;
        if (cosl <= 0)
            return color(0, 0, 0);
        float azimuth = max(0, normalize(V - Nn * cosv) . normalize(Ln - Nn * cosl));
        float thetal = acos(clamp(cosl, -1, 1));
        float thetav = acos(clamp(cosv, -1, 1));
        float a = max(thetal, thetav);
        float b = min(thetal, thetav);
        return light * cosl * (A + B * azimuth * sin(a) * tan(min(b, 1.5)));
    }
    point Q = scale * transform("object", P);
    float sea = smoothstep(0.46, 0.56, float noise(1.1 * Q) + 0.18 * (float noise(5 * Q) - 0.5));

    /* Young craters: a few places on the ball, with rays. */
    float rays = 0;
    float height = 0.6 * float noise(4 * Q) + 0.4 * float noise(9 * Q) + 0.25 * float noise(23 * Q);
    uniform float k;
    for (k = 0; k < 9; k += 1) {
        uniform vector D = normalize(vector cellnoise(k + 0.5, 3.5) - vector(0.5, 0.5, 0.5));
        vector at = normalize(Q - point(0, 0, 0));
        float away = acos(clamp(at . D, -1, 1));
        uniform float size = 0.05 + 0.12 * float cellnoise(k + 0.5, 9.5);
        uniform vector X = normalize(D ^ vector(0.3, 0.5, 0.8));
        uniform vector Y = D ^ X;
        float turn = atan(at . Y, at . X);
        float spoke = float pnoise(5 * turn / PI + 5, 10) * float noise(14 * turn / PI + 3 * k, 3 * away);
        rays += smoothstep(0.16, 0.34, spoke) * exp(-away / (4 * size)) * smoothstep(0.7 * size, size, away);
        float r = away / size;
        height += 3 * size * ((r < 1 ? r * r - 1 : 0) + 1.1 * exp(-8 * (r - 1) * (r - 1)));
    }
    normal Nn = calculatenormal(P + relief * height * normalize(N));
    normal Nf = faceforward(normalize(Nn), I);
    vector V = -normalize(I);
    color Ct = mix(highland, seacolor, sea);
    Ct = mix(Ct, raycolor, clamp(rays, 0, 0.8));
    Ct *= 0.85 + 0.3 * (float noise(30 * Q) - 0.5) + 0.2 * float noise(8 * Q);
    color total = 0;
    illuminance(P, Nf, PI / 2) {
        total += dust(Nf, V, normalize(L), Cl, sigma);
    }
    Oi = Os;
    Ci = Os * Ct * (Ka * ambient() + Kd * total);
}
