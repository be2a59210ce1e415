/* defaultsurface.sl: what RenderMan scenes wear before any Surface: lit from the eye. */
surface defaultsurface(float Ka = 0.2, Kd = 0.8; string texturename = "") {
    float facing = normalize(I) . normalize(N);
    color base = Cs;
    if (texturename != "") base *= color texture(texturename);
    Oi = Os;
    Ci = Os * base * (Ka + Kd * facing * facing);
}
