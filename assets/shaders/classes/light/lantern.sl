/* lantern.sl: a pierced lantern: stars of light all around a flame. construct() makes the table of
   the holes' rows once.
   Parameters: intensity, lightcolor, rows, holes (of a row), flicker. */
class lantern(float intensity = 9; color lightcolor = color(1, 0.72, 0.38); uniform float rows = 7;
              float holes = 12; float flicker = 0.25;) {
    uniform float count[];
    constant float beat = time * 4;

    public void construct() {
        uniform float k;
        resize(count, rows);
        for (k = 0; k < rows; k += 1)
            count[k] = max(1, floor(holes * 2 * sin(PI * (k + 0.5) / rows) + 0.5));
    }
    float star(float x, y) {
        float r = sqrt(x * x + y * y), angle = atan(y, x);
        return 1 - smoothstep(0.8, 1, r / (0.5 + 0.22 * cos(5 * angle)));
    }
    public void light(output vector L; output color Cl) {
        illuminate(point "shader" (0, 0, 0)) {
            vector way = normalize(vtransform("shader", L));
            float place = acos(clamp(way[1], -1, 1)) / PI * rows;
            float row = min(floor(place), rows - 1);
            float turn = (atan(way[0], way[2]) / (2 * PI) + 0.5) * count[row];
            float hole = star(2 * mod(turn, 1) - 1, 2 * (place - row) - 1);
            float calm = 1 - flicker * float noise(beat);
            Cl = intensity * calm * lightcolor * (0.05 + hole) / (0.3 + L . L);
        }
    }
}
