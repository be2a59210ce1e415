/* discoball.sl: a turning ball of mirrors throws rows of coloured spots on everything.
   Parameters: intensity, facets around the ball, spin in turns a second, spot (size 0..1), colors
   (how far hues differ; 0: white). */
light discoball(float intensity = 34; float facets = 42; float spin = 0.1; float spot = 0.62;
                float colors = 0.7;) {
    illuminate(point "shader" (0, 0, 0)) {
        vector D = normalize(vtransform("shader", L));
        setzcomp(D, -zcomp(D));
        D = vector rotate(point D, 2 * PI * spin * time, point(0, 0, 0), point(0, 1, 0));
        float latitude = asin(clamp(ycomp(D), -1, 1));
        float row = floor(facets / 2 * latitude / (PI / 2) + 0.5);
        uniform float steps = facets / 2;
        float y = steps * latitude / (PI / 2) + 0.5 - row;
        /* Fewer mirrors in the rows near the poles. */
        float count = max(3, round(facets * cos(row / steps * PI / 2) * 2));
        float x = count * (atan(zcomp(D), xcomp(D)) / (2 * PI) + 0.5) + 0.5 * mod(row, 2);
        float column = floor(x);
        float dx = 2 * (x - column) - 1;
        float dy = 2 * y - 1;
        float mirror = 1 - smoothstep(0.7 * spot, spot, sqrt(dx * dx + dy * dy));
        float id = float cellnoise(mod(column, count) + 0.5, row + 100.5);
        color hue = ctransform("hsl", "rgb", color(id, 1, 0.5));
        hue = mix(color(1, 1, 1), hue, colors);
        float bright = 0.5 + 0.8 * float cellnoise(mod(column, count) + 0.5, row + 300.5);
        Cl = intensity * bright * mirror * hue / (L . L);
    }
}
