// world 19
// The reference took the first of four corners for their middle.
surface fuzz(float frame_26 = -1.265; float frame_27 = 1; float own_28 = -1.141; varying float vary_29 = -1.028;) {
    Ci = color (float environment("camera", 1, 1, dPdv, dPdtime), vary_29, float environment("camera", dPdu, I, N, P));
    Ci += color texture("a", 0, v, 1, s, u, 1, t, frame_26) * float shadow("a", P, Ng, dPdv, point (1, 2, 3));
}
