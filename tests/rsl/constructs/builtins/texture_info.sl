// textureinfo, rendererinfo, attribute, option
surface texture_info(string map = "grid.tx") {
    float size[2] = {0, 0};
    float channels = 0, rate = 1;
    float known = textureinfo(map, "resolution", size);
    known += textureinfo(map, "channels", channels);
    string renderer = "";
    rendererinfo("renderer", renderer);
    uniform float format[3];
    if (option("Format", format) == 1) known += 0;
    attribute("ShadingRate", rate);
    Ci = Cs;
    if (renderer == "") Ci = 0;
}
