// floats and strings as conditions
surface control_float_condition(float useshadow = 1; string map = "") {
    float side = s - 0.5;
    if (useshadow) Ci = Cs;
    if (side) Ci += 0.1;
    if (!useshadow) Ci = 0;
    if (map != "") Ci *= 2;
    if (map) Ci *= 3;
    Ci += side ? 0.1 : 0.2;
    while (side) side = 0;
}
