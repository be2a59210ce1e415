surface x(string what = "dirt"; output float own = 0;) {
    float k, dirt = 0;
    for (k = 0; k < 3; k += 1) writeaov(format("light_%d", k), Cs * k);
    readprimvar(what, dirt);
    own = dirt;
    Ci = dirt;
}
