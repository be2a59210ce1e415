// a light with noise, transforms and a shadow map
light light_textured(string slidename = "", shadowname = ""; float width = 2, samples = 16, blur = 0.01, bias = 0.1) {
    uniform point from = point "shader"(0, 0, 0);
    uniform vector axis = normalize(vector "shader"(0, 0, 1));
    illuminate(from, axis, radians(40)) {
        point PL = transform("shader", Ps);
        float x = xcomp(PL) / zcomp(PL) * width, y = ycomp(PL) / zcomp(PL) * width;
        Cl = color(0.5 + x, 0.5 + y, 1) * float noise(PL * 3);
        if (slidename != "") Cl *= color texture(slidename, x, y, "blur", 0.01);
        if (shadowname != "") Cl *= 1 - shadow(shadowname, Ps, "samples", samples, "blur", blur, "bias", bias);
    }
}
