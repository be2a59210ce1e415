// strings compared, concatenated, formatted, in arrays, by conditional
surface expression_strings(string mode = "wood"; float frame = 12) {
    string file = concat(mode, ".", format("%04f", frame), ".tx");
    string made = format("%s and %f", mode, frame);
    string names[2] = {"a\tb", "c\"d\\"};
    uniform string joined = "one " "two";
    Ci = Cs;
    if (mode == "wood") Ci *= 0.5;
    if (mode != "marble" && joined == "one two") Ci += 0.1;
    if (names[0] == "a\tb") Ci += 0.2;
    if (match("wo*", mode)) Ci += 0.05;
    if (file == "") Ci = 0;
    if (made == mode) Ci = 0;
}
