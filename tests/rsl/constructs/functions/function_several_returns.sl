// several return statements
float stripe(float x) {
    if (x < 0.25) return 0.1;
    if (x < 0.5) {
        return 0.7;
    } else if (x < 0.75)
        return x;
    return 1 - x;
}
color pick(float which; color a, b, c) {
    float i;
    for (i = 0; i < 4; i += 1)
        if (i > which * 4) return mix(a, b, i / 4);
    return c;
}
surface function_several_returns() { Ci = stripe(s) * pick(t, Cs, color(1, 0, 0), color(0, 0, 1)); }
