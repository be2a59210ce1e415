// A light's surface, by its corners in rows or around; environments as lights.
surface x(string map = "raytrace";) {
    point a = point (0, 0, 1), b = point (1, 0, 1), c = point (0, 1, 1), d = point (1, 1, 1.5);
    float hidden = shadow(map, P, "source", a, b, c, d, "samples", 9, "bias", 0.01);
    color tinted = shadow(map, P, "blur", 0.1, "source", (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1));
    float blocked = 0;
    color sky = 0;
    vector way = 0;
    float angle = 0;
    Ci = hidden + tinted + indirectdiffuse(map, N) + indirectdiffuse(map, N, 8);
    Ci += indirectdiffuse(P, N, 4, "occlusion", blocked) * (1 - blocked);
    gather("environment:sky.exr", P, N, PI / 2, 16, "environment:color", sky,
           "environment:direction", way, "environment:solidangle", angle)
        Ci += sky * angle * max(0, normalize(way) . N) / PI;
}
