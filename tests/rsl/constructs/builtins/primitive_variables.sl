// readprimvar() and getvar(null, ..): what the mesh brings and nothing declares; names made at run time
surface primitive_variables(string what = "vary_one"; varying float vary_two = 3;
                            float list[2] = {5, 6};
                            output varying float aov_known = 0; output varying color aov_sum = 0;) {
    float f = 1, none = 7, own = 2, k, last = 0;
    color c = 0;
    point p = 0;
    normal n = 0;
    string kept = "kept";
    aov_known = readprimvar("vary_one", f) + 10 * readprimvar("absent", none);
    aov_known += 100 * getvar(null, "vary_one", c) + 1000 * readprimvar("vary_two", own);
    aov_known += readprimvar("vary_one", p) + readprimvar("vary_one", n) + readprimvar("text", kept);
    aov_known += getvar(null, what, c) + 3 * getvar(null, "vary_one") + 5 * getvar(null, "gone");
    uniform string names[3] = {"s", "vary_two", "Kd"};
    for (k = 0; k < 3; k += 1) {
        if (readprimvar(names[k], last) == 1) own += last;
        aov_known += readprimvar(concat("vary_", names[k]), last);
    }
    float copy[];
    aov_known += readprimvar(concat("li", "st"), copy);
    readprimvar(concat("P", ""), p);
    aov_sum = c * f + color(xcomp(p), own, none) + color(n) + Du(f) * 0.125 + copy[1];
    if (kept == "kept") aov_sum += 1;
    Ci = aov_sum * aov_known;
    Oi = 1;
}
