// solar(axis, angle) and solar()
light light_solar(float intensity = 1; color lightcolor = 1; point from = point "shader"(0, 0, 0);
                  point to = point "shader"(0, 0, 1)) {
    if (intensity > 0)
        solar(to - from, 0.0) Cl = intensity * lightcolor;
    else
        solar() { Cl = 0.1; }
}
