// surface displacement atmosphere incident opposite shadername
surface messages() {
    float Km = 0;
    color c = 0;
    string name = shadername();
    if (displacement("Km", Km) == 1) c += Km;
    if (surface("Ka", Km) != 0) c += Km;
    atmosphere("distance", Km);
    incident("x", c);
    opposite("y", c);
    Ci = c;
}
