// writeaov and readaov of names made at run time, beside declared and literal ones
void keep(float k; color c) { writeaov(format("light_%d", k), c); }
surface named_outputs_run_time(string what = "weight"; float count = 3;
                               output varying float declared = 0; output varying color lamps[2] = {0, 0};) {
    uniform float k;
    float x = 5, none = 7;
    color c = 9;
    writeaov("plain", s);
    for (k = 0; k < count; k += 1) {
        keep(k, color(k, s, t));
        if (s > 0.5) writeaov(concat("weight", "_", "1"), k * t);
        lamps[mod(k, 2)] += color(k, s, 2);
    }
    writeaov(concat("decl", "ared"), s * t);
    writeaov(what, P);
    float known = readaov("plain", x) + readaov(concat("light", "_1"), c);
    known += readaov(format("light_%d", 77), none) * 10 + readaov(concat("declared", ""), x) * 100;
    Ci = c * x + none + known + declared + lamps[1];
    Oi = 1;
}
