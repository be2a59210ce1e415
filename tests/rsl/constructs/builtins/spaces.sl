// transform vtransform ntransform of named spaces, ctransform, depth
surface spaces() {
    point a = transform("shader", P), b = transform("world", "object", P), c = transform("NDC", P);
    vector d = vtransform("shader", I), e = vtransform("object", "world", d);
    normal f = ntransform("world", N);
    point g = transform("camera", point "world"(0, 0, 0));
    color h = ctransform("hsv", Cs), i = ctransform("rgb", "hsl", Cs), j = color "hsv"(0.5, comp(h, 1), 1);
    Ci = color a * 0.01 + color b * 0.01 + color c * 0.01 + color d * 0.01 + color e * 0.01 + color f * 0.1;
    Ci += color g * 0.01 + h * 0.1 + i * 0.1 + j * 0.1 + depth(P) * 0.01;
}
