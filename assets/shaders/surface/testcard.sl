/* testcard.sl: a card that shows what a renderer knows of a point: panels of s and t, the normals,
   the derivatives, the spaces, each with a frame. For looking at new geometry.
   Parameters: panels (along s; half as many along t), show: "" for all panels, or the name of one:
   st, uv, N, Ng, Pobject, Pworld, dPdu, dPdv, pixel, velocity; "Nboth" for N - Ng. */
#define SIGNED(v) (0.5 * ((color) (v)) + color(0.5, 0.5, 0.5))

surface testcard(float panels = 12; string show = "";) {
    string names[10] = {"st", "uv", "N", "Ng", "Pobject", "Pworld", "dPdu", "dPdv", "pixel",
                        "velocity"};
    color panel(uniform string name) {
        extern point P;
        color shown = 0;
        if (name == "st")
            shown = color(s, t, 0.2);
        else if (name == "uv")
            shown = color(0.2, mod(u, 1), mod(v, 1));
        else if (name == "N" || name == "Ng")
            shown = SIGNED(normalize(ntransform("world", name == "N" ? N : Ng)));
        else if (name == "Pobject")
            shown = SIGNED(transform("object", P));
        else if (name == "Pworld")
            shown = (color) transform("world", P);
        else if (name == "dPdu")
            shown = SIGNED(normalize(vtransform("object", dPdu)));
        else if (name == "dPdv")
            shown = SIGNED(normalize(vtransform("object", dPdv)));
        else if (name == "pixel")
            shown = color(du * 60, dv * 60, Deriv(t, s) + 0.5);
        else
            shown = SIGNED(dPdtime) * (1 + dtime);
        return shown;
    }
    float x = panels * s;
    float y = panels / 2 * t;
    float which = mod(floor(x) + 3 * floor(y), 10);
    color Ct = 0;
    /* Both normals at once, or one panel for the whole card, or all of them. */
    if (match("^N.*both$", show) == 1) {
        Ct = SIGNED(normalize(N) - normalize(Ng));
    } else if (show != "") {
        Ct = panel(show);
    } else {
        uniform float k = 0;
        while (k < 10) {
            if (which == k)
                Ct = panel(names[k]);
            k += 1;
        }
    }
    float edge = min(0.5 - abs(x - floor(x) - 0.5), 0.5 - abs(y - floor(y) - 0.5));
    float w = abs(Du(edge) * du) + abs(Dv(edge) * dv);
    Ct *= smoothstep(0.01, 0.03 + w, edge);
    vector V = -normalize(I);
    normal Nf = faceforward(normalize(N), I);
    Oi = Os;
    Ci = Os * Ct * (0.45 + 0.55 * (V . Nf)) * (ncomps / 3);
}
