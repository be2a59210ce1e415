/* softbox.sl: a photographer's soft box: a lamp behind a square of cloth in its x, y plane, shining
   along z, whose shadows are as soft as the cloth is wide.
   Parameters: intensity, lightcolor, width and height of the cloth. */
light softbox(float intensity = 1; color lightcolor = 1; float width = 1; float height = 1;) {
    point corner = point "shader" (-width / 2, -height / 2, 0);
    point right = point "shader" (width / 2, -height / 2, 0);
    point above = point "shader" (-width / 2, height / 2, 0);
    point middle = point "shader" (0, 0, 0);
    vector axis = vector "shader" (0, 0, 1);
    illuminate(middle, axis, PI / 2) {
        float hidden = float areashadow("", Ps, corner, right, above);
        float area = width * height;
        Cl = intensity * lightcolor * area * (normalize(L) . axis) / (L . L) * (1 - hidden);
    }
}
