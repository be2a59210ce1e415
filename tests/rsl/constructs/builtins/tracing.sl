// trace, transmission, visibility, rayinfo, raydepth by rayinfo
surface tracing(float samples = 4) {
    normal Nf = faceforward(normalize(N), I);
    vector R = reflect(normalize(I), Nf);
    uniform float depth = 0;
    rayinfo("depth", depth);
    color c = 0;
    if (depth < 2) c = trace(P, R);
    float hit = trace(P, R);
    color through = transmission(P, P + R * 10, "samples", samples);
    Ci = c * through + (hit > 0 ? 0.1 : 0);
}
