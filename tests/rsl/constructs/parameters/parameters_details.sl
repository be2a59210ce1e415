// uniform, varying and output parameters
surface parameters_details(uniform float a = 1; varying float b = 2, c = 3; output varying color glow = 0;
                           varying output float mask = 0; output float plain = 0) {
    glow = color(a, b, c) * 0.1;
    mask = s > 0.5;
    plain = t;
    Ci = glow + mask;
}
