surface x(string name = "a.tif"; string names[2] = {"a", "b"}; float Kr = 0;) {
    float a = texture(name[1], s, t);
    color b = texture("b" ".tif", s, t, "blur", 0.1, "filter", "box");
    float c = texture(names[1][2]);
    color d = color texture(names[0], s, t, s, t, s, t, s, t);
    if (name != "") Ci = texture(name);
    Ci += Kr * color environment(name, reflect(I, N)) + a * b + c * d;
    Ci *= 1 - shadow("s.shd", P, "samples", 16, "bias", 0.01);
}
