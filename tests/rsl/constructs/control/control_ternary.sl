// conditional expressions, nested, mixed types, as arguments
surface control_ternary() {
    color c = s > 0.5 ? Cs : t > 0.5 ? color(1, 0, 0) : 0.25;
    float f = (s > t) ? s : t;
    point p = f > 0.5 ? P : (0, 0, 0);
    string which = f > 0.3 ? "hi" : "lo";
    Ci = c * (f > 0.5 ? 1 : 2) + color(p) * 0.01 + mix(0, 1, s > 0.1 ? s : 0.1);
    if (which == "hi") Ci += 0.1;
}
