// exporter style: many parameters, macros for texture slots, underscores
#define SLOT_COLOR(n, map, amount) if (map != "") { color tc##n = color texture(map, ss, tt); Ct = mix(Ct, tc##n, amount * chan##n); }
#define MAXSLOT 2
surface style_mosaic(float Ka = 1.0; float Kd = 0.8; float Ks = 0.5; float Hard = 50; color DiffCol = color(0.8, 0.8, 0.8);
    color SpecCol = color(1.0, 1.0, 1.0); float Emit = 0.0; float Alpha = 1.0; string Tex_0 = ""; string Tex_1 = "";
    float chan0 = 1.0; float chan1 = 0.5; float Shadeless = 0; float SizeX = 1.0; float SizeY = 1.0;
    output varying color _ambient = color(0, 0, 0); output varying color _diffuse = color(0, 0, 0);) {
    float ss = s * SizeX; float tt = 1.0 - t * SizeY;
    color Ct = DiffCol;
    SLOT_COLOR(0, Tex_0, 1.0)
    SLOT_COLOR(1, Tex_1, 0.5);
#if MAXSLOT > 3
    SLOT_COLOR(2, Tex_2, 0.5)
#endif
    normal Nf = faceforward(normalize(N), I);
    if (Shadeless == 1) { Ci = Ct; }
    else {
        _ambient = Ka * ambient(); _diffuse = Kd * diffuse(Nf);
        Ci = Ct * (_ambient + _diffuse + Emit) + SpecCol * Ks * specular(Nf, -normalize(I), 1.0 / Hard);
    }
    Oi = Alpha * Os; Ci *= Oi;
}
