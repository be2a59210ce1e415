// Functions that differ in their result alone: what is wanted chooses.
float spot(float x) { return 2 * x; }
color spot(float x) { return color(x, 0, 1); }
color spot(float x; color c) { return c * x; }
surface x() {
    color c = spot(s);
    float f = spot(s);
    Ci = c * spot(t) + f + spot(s, Cs) + color spot(0.5) + comp(color spot(t), 2);
    if (spot(s) > 0.5) Ci += mix(spot(s), Cs, 0.5);
}
