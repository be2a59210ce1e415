/* copperpatina.sl: hammered copper whose hollows have gone green. displacement() computes the
   dents once; prelighting() reads them for the patina, the lights for the metal's shine.
   Parameters: dents (a unit), depth, age (0 to 1), copper, patina, roughness. */
class copperpatina(float dents = 5; float depth = 0.05; float age = 0.55;
                   color copper = color(0.75, 0.36, 0.2); color patina = color(0.22, 0.5, 0.43);
                   float roughness = 0.22;) {
    varying float hollow = 0;  // 0 on the rims, 1 at the bottom of a dent
    varying float green = 0;
    varying color base = 0;

    void dent(point Q) {
        point cell = point(floor(Q[0]), floor(Q[1]), floor(Q[2]));
        float i, j, k, near = 4;
        for (i = -1; i <= 1; i += 1)
            for (j = -1; j <= 1; j += 1)
                for (k = -1; k <= 1; k += 1) {
                    point at = cell + vector(i, j, k);
                    at += vector cellnoise(at);
                    near = min(near, distance(at, Q));
                }
        hollow = 1 - smoothstep(0, 0.75, near);
    }
    public void displacement(output point P; output normal N) {
        dent(dents * transform("object", P));
        vector n = normalize(N);
        P -= depth * hollow * n;
        N = calculatenormal(P);
    }
    public void prelighting(output color Ci, Oi) {
        point Q = transform("object", P);
        float cloud = float noise(2.1 * Q) * 0.6 + float noise(5.3 * Q) * 0.3 + float noise(13 * Q) * 0.2;
        float run = float noise(point(9 * Q[0], 1.4 * Q[1], 9 * Q[2]));
        green = smoothstep(1 - age, 1.25 - age, 0.55 * cloud + 0.35 * hollow + 0.25 * run);
        base = mix(copper, patina * mix(0.75, 1.2, cloud), green);
    }
    public void lighting(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        vector V = -normalize(I), R = reflect(-V, Nf);
        color shine = specular(Nf, V, roughness) + 0.8 * color trace(P, R);
        color matte = base * (ambient() + diffuse(Nf));
        Ci = Oi * mix(copper * shine + 0.25 * matte, matte, green);
    }
}
