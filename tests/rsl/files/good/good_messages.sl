surface x() {
    float a; color c; string name; float res[2];
    if (displacement("amp", a) == 1 && atmosphere("density", a) != 0) Ci = a;
    if (textureinfo("a.tex", "resolution", res) == 1) Ci += res[0];
    attribute("identifier:name", name);
    option("Format", res);
    incident("c", c); opposite("c", c); surface("c", c);
    rayinfo("depth", a);
    Ci += c + a;
}
volume fog(float distance = 1;) {
    float d = 1 - exp(-length(I) / distance);
    Ci = mix(Ci, color 1, d);
    Oi = mix(Oi, color 1, d);
}
imager back(color background = 0;) {
    Ci += (1 - alpha) * background;
    Oi = 1; alpha = 1;
}
transformation bend(float k = 1;) { P += k * (0, 1, 0); }
