// gather with everything that may follow its five arguments; messages into uniform variables.
surface x(float samples = 16; string map = "x.pts";) {
    color c = 0, sum = 0;
    vector way = 0;
    uniform float depth = 0, rate = 1;
    uniform string kind = "";
    rayinfo("depth", depth);
    rayinfo("type", kind);
    attribute("ShadingRate", rate);
    if (depth < 3) {
        gather("illuminance", P, N, PI / 2, samples, "surface:Ci", c, "ray:direction", way,
               "distribution", "cosine", "bias", 0.01, "maxdist", 100, "label", "x") {
            sum += c;
            if (xcomp(way) > 2) break;
        } else {
            if (ycomp(way) > 2) continue;
            sum += 1;
        }
    }
    float a = 0;
    color b = 0;
    float ok = texture3d(map, P, N, "_a", a, "_b", b, "filterradius", samples);
    bake3d(map, "_a,_b", P, N, "_a", a, "_b", b, "radius", 0.1, "interpolate", 1);
    vector open = 0;
    Ci = sum * ok + occlusion(P, N, 4, "environmentdir", open) + indirectdiffuse(P, N, 4);
    Ci += color(transmission(P, P + N)) * visibility(P, P + N) + trace(P, N) + xcomp(open) + b + a;
}
