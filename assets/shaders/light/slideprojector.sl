/* slideprojector.sl: throws a picture: the image `slide`, or without one a slide of its own (rings
   and spokes in colours) through a square gate.
   Parameters: intensity, fov in degrees of the gate, slide, blur, from (the lamp, looks along z of
   its own space). */
#define SLIDE_GATE 0.96

light slideprojector(float intensity = 22; float fov = 34; float blur = 0.02; string slide = "";
                     point from = point "shader" (0, 0, 0);) {
    uniform vector axis = normalize(vector "shader" (0, 0, 1));
    uniform float reach = tan(radians(fov) / 2);

    /* What the gate shows at x, y in -1..1. */
    color picture(float x; float y; uniform float blurred) {
        float r = sqrt(x * x + y * y);
        float angle = degrees(atan(y, x)) / 360;
        color wheel = ctransform("hsv", "rgb", color(mod(angle, 1), 0.75, 1));
        float rings = smoothstep(0.5 - blurred, 0.5 + blurred, abs(mod(3 * r, 1) - 0.5) * 2);
        float spokes = smoothstep(-blurred, blurred, sin(8 * 2 * PI * angle));
        float disk = 1 - smoothstep(0.8 - blurred, 0.8 + blurred, r);
        float checker = abs(rings - spokes);
        return mix(color(1, 0.93, 0.8), mix(0.25 * wheel, wheel, checker), disk);
    }
    illuminate(from, axis, atan(1.5 * reach)) {
        vector beam = vtransform("shader", L);
        float away = max(zcomp(beam), 0.0001);
        float x = xcomp(beam) / (away * reach);
        float y = ycomp(beam) / (away * reach);
        color shown;
        if (slide != "")
            shown = color texture(slide, 0.5 + 0.5 * x, 0.5 + 0.5 * y, "blur", blur);
        else
            shown = picture(x, y, max(blur, 0.001));
        float gate = max(abs(x), abs(y));
        shown *= 1 - smoothstep(SLIDE_GATE - blur, SLIDE_GATE + blur, gate);
        Cl = intensity * shown / (L . L);
    }
}
