// C-style commas between parameters
surface parameters_c_commas(float Ka = 1, float Kd = 0.8, color base = color(0.2, 0.4, 0.6), string unused = "x") {
    Oi = Os;
    Ci = Oi * base * (Ka + Kd * (normalize(N) . vector(0, 0, -1)));
}
