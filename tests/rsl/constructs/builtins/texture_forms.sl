// texture with and without coordinates, eight coordinates, channel, options, typed
surface texture_forms(string map = "grid.tx"; float blur = 0.01) {
    color c = texture(map), d = color texture(map, s, t), e = texture("grid.tx", s * 2, t, "blur", blur);
    float a = texture(map[0]), b = float texture(map[1], s, t, "swidth", 2, "twidth", 2);
    color f = texture(map, s, t, s + 0.1, t, s, t + 0.1, s + 0.1, t + 0.1, "filter", "gaussian");
    Ci = c + d + e + a + b + f;
    if (map != "") Ci *= texture(map);
}
