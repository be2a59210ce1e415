// Du Dv Deriv area calculatenormal filterstep du dv
surface derivatives() {
    float fw = max(abs(Du(s) * du) + abs(Dv(s) * dv), 1e-6);
    float size = sqrt(area(P)) + area(P, "dicing");
    vector across = Du(P) ^ Dv(P);
    normal bumped = calculatenormal(P + 0.1 * sin(s * 6) * normalize(N));
    Ci = fw + size * 0.1 + color across * 0.01 + color(normalize(bumped)) * 0.1 + Deriv(s, t) * 0.01;
    Ci += filterstep(0.5, s) + filterstep(0.5, s, s + 0.1) + filterstep(0.5, t, "width", 2, "filter", "box");
    Ci += smoothstep(0.5 - fw, 0.5 + fw, s) + color(Du(Cs)) * 0.1;
}
