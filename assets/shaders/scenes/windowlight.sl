/* windowlight.sl: the sun through a window of panes in a wall of constant x (world space). A point
   looks back along the light to the wall: where it meets glass it is lit, elsewhere it sees only
   the dim sky of the room. The edges of the panes are blurred. */
light windowlight(float intensity = 1;
                  point from = point "world" (-4, -0.9, 2.6); /* middle of the window */
                  point to = point "world" (0, 0, 0);         /* where the sun shines */
                  float order = 2;                            /* panes from the middle outwards */
                  float fuzz = 0.03; float framewidth = 0.10; float panewidth = 0.52;
                  color lightcolor = color(1, 0.82, 0.52);
                  color darkcolor = color(0.012, 0.022, 0.05);) {
    point window = transform("world", from);
    vector beam = transform("world", to) - window;
    point Pworld = transform("world", Ps);

    /* Project onto the wall along the beam, and measure from the middle of the window. */
    vector back = beam * ((xcomp(window) - xcomp(Pworld)) / xcomp(beam));
    vector offset = (Pworld + back) - window;
    float y = abs(ycomp(offset));
    float z = abs(zcomp(offset));

    float pitch = framewidth + panewidth;
    float shade = 0;
    if (max(y, z) < pitch * order) {
        float inner = 0.5 * framewidth - fuzz;
        float outer = 0.5 * framewidth + fuzz;
        float ypane = mod(y, pitch);
        float zpane = mod(z, pitch);
        shade = smoothstep(inner, outer, ypane) * smoothstep(inner, outer, pitch - ypane) *
                smoothstep(inner, outer, zpane) * smoothstep(inner, outer, pitch - zpane);
    }
    solar(to - from, 0) {
        Cl = intensity * mix(darkcolor, lightcolor, shade);
    }
}
