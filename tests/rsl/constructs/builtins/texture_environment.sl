// environment by a direction and by four, channel, shadow maps
surface texture_environment(string env = "sky.env", shad = "") {
    vector R = reflect(normalize(I), normalize(N));
    color c = environment(env, R), d = color environment(env, vtransform("world", R), "blur", 0.1);
    float a = float environment(env[0], R);
    color e = environment(env, R, R + 0.1, R + 0.2, R + 0.3);
    float sh = 0;
    if (shad != "") sh = shadow(shad, P, "samples", 16, "blur", 0.01, "bias", 0.2);
    Ci = (c + d + a + e) * (1 - sh);
}
