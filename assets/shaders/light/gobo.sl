/* gobo.sl: sunlight through the leaves of a tree: a spotlight with a cut-out of blurred leaf
   shadows in front, which stirs with time.
   Parameters: intensity, lightcolor, leafcolor (light that comes through a leaf), scale (leaves
   across the beam), density 0..1, softness, coneangle in degrees. */
light gobo(float intensity = 24; float scale = 7; float density = 0.58; float softness = 0.10;
           float coneangle = 26; float wind = 0.3;
           color lightcolor = color(1, 0.92, 0.72); color leafcolor = color(0.10, 0.16, 0.03);) {
    uniform vector axis = normalize(vector "shader" (0, 0, 1));
    illuminate(point "shader" (0, 0, 0), axis, radians(coneangle)) {
        vector beam = vtransform("shader", L);
        float x = scale * xcomp(beam) / max(zcomp(beam), 0.0001) * 2;
        float y = scale * ycomp(beam) / max(zcomp(beam), 0.0001) * 2;
        /* Three layers of leaves, each a cell with an ellipse that leans its own way. */
        float open = 1;
        uniform float layer;
        for (layer = 0; layer < 3; layer += 1) {
            float px = x + 17.3 * layer + 0.2 * wind * sin(2 * time + layer);
            float py = y + 5.7 * layer;
            float bx = px + 0.7 * (float noise(1.3 * px, 1.3 * py) - 0.5);
            float by = py + 0.7 * (float noise(1.3 * px + 9, 1.3 * py) - 0.5);
            float cx = floor(bx);
            float cy = floor(by);
            float turn = 2 * PI * float cellnoise(cx + 0.5, cy + 0.5 + layer);
            float dx = bx - cx - 0.5;
            float dy = by - cy - 0.5;
            float ex = (dx * cos(turn) + dy * sin(turn)) / 0.52;
            float ey = (dy * cos(turn) - dx * sin(turn)) / 0.26;
            float leaf = 1 - smoothstep(1 - 3 * softness, 1 + 3 * softness, ex * ex + ey * ey);
            leaf *= step(float cellnoise(cx + 7.5, cy + 3.5 - layer), density);
            open *= 1 - leaf;
        }
        float cosangle = (L . axis) / length(L);
        float edge = smoothstep(cos(radians(coneangle)), cos(0.8 * radians(coneangle)), cosangle);
        Cl = intensity * edge * mix(leafcolor, lightcolor, open) / (L . L);
    }
}
