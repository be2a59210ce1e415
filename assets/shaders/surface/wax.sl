/* wax.sl: a candle's wax: light from below the surface and of photons out of point files over a
   soft matte; without files it is the matte alone.
   Parameters: Kd, scatter ("_ssdiffusion" of each point), photons and caustics ("power" of each). */
surface wax(float Kd = 0.7; color tint = color(1, 0.87, 0.62); string scatter = "";
            string photons = ""; string caustics = "";) {
    normal Nf = faceforward(normalize(N), I);
    color light = ambient() + diffuse(Nf);
    /* Wax is never quite dark where it turns from the light. */
    illuminance(P, Nf, PI)
        light += 0.25 * Cl * smoothstep(-1, 0.6, normalize(L) . Nf);
    if (scatter != "")
        light += subsurface(scatter, P, Nf);
    if (photons != "")
        light += photonmap(photons, P, Nf, "estimator", 50);
    if (caustics != "")
        light += caustic(caustics, P, Nf);
    Oi = Os;
    Ci = Oi * (Cs * tint * Kd * light + 0.15 * specular(Nf, -normalize(I), 1.6));
}
