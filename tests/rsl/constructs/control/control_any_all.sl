// PRMan's while "any" (...), if "all" (...) and for "any" (...): each point is a grid of its own
surface control_any_all(output varying float aov_turns = 0;) {
    float i = 0, k;
    while "any" (i < 3 + floor(s * 3)) {
        i += 1;
    }
    if "all" (s > 0.5) i += 10;
    else if "any" (t > 0.5) i += 20;
    for "any" (k = 0; k < floor(t * 4); k += 1) aov_turns += k;
    aov_turns += i;
    Ci = aov_turns;
    Oi = 1;
}
