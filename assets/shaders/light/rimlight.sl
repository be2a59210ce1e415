/* rimlight.sl: light only for outlines: it strikes what turns away from the camera, wherever the
   lamp stands. It is left out of specular() and answers the category "rim".
   Parameters: intensity, lightcolor, width (0..1, how far it reaches in from the edge). */
light rimlight(float intensity = 1.6; color lightcolor = color(0.45, 0.75, 1); float width = 0.55;
               output float __nonspecular = 1; output string __category = "rim";) {
    vector toward = normalize(E - Ps);
    float facing = abs(normalize(vector Ns) . toward);
    float edge = pow(1 - smoothstep(0, width, facing), 1.5);
    /* It comes from where the surface looks, so that its strength is the edge's alone. */
    solar(-vector Ns, 0) {
        Cl = intensity * edge * lightcolor;
    }
}
