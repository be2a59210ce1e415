/* envlight.sl: light from all around, as a picture of the surroundings shows it. Directions are as
   dense as the picture is bright. Its middle lies where the light looks, its top along the light's
   y; only the light's turn counts. A picture is latitudes and longitudes, or six faces.
   Parameters: map ("": white), tint, intensity, samples (of each lit point; 0: as many as the
   renderer takes of a lamp). */
class envlight(uniform string map = ""; uniform color tint = 1; uniform float intensity = 1;
               uniform float samples = 0; output float __environment = 1;) {
    uniform vector ahead = normalize(vector "shader" (0, 0, 1));
    uniform vector side = vector "shader" (1, 0, 0);
    uniform vector right = normalize(side - (side . ahead) * ahead);
    uniform vector side2 = vector "shader" (0, 1, 0);
    uniform vector up = normalize(side2 - (side2 . ahead) * ahead - (side2 . right) * right);

    vector in_map(vector D) { return vector(-(D . right), D . up, D . ahead); }
    vector of_map(vector D) { return D[1] * up + D[2] * ahead - D[0] * right; }
    color light_along(vector in_map) { return intensity * tint * maplight(map, in_map); }

    public void generateSamples(string what; output __radiancesample s[]) {
        uniform float i, n = samples;
        float density = 0;
        if (n == 0) rayinfo("lampsamples", n);
        resize(s, n);
        for (i = 0; i < n; i += 1) {
            float x = random(), y = random();
            vector D = mapdirection(map, x, y, density);
            s[i]->setLightSample(light_along(D), density, of_map(D), 1e30);
        }
    }
    public void evaluateSamples(string what; output __radiancesample s[]) {
        uniform float i;
        for (i = 0; i < arraylength(s); i += 1) {
            vector D = in_map(s[i]->direction);
            s[i]->setLightSample(light_along(D), mapdensity(map, D));
        }
    }
}
