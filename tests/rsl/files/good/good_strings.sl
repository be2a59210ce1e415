surface x(uniform string a = "x";) {
    string b = concat(a, ".", "tex");
    uniform string c = format("%f %s", 1, b);
    if (match("te*", b) == 1 && a != "x") printf("%p %s\n", P, shadername());
    Ci = c == b ? 1 : 0;
}
