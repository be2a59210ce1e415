/* granite.sl: polished grey granite: grains of quartz, feldspar and mica, each a cell of stone.
   Parameters: scale (grains per object unit), the three minerals' colours, the share of dark mica,
   and the plastic-like Ka Kd Ks roughness of the polish. */

/* Distance to the nearest and second nearest of points scattered one to a cell, and the number
   of the nearest: a grain. */
void nearest_grain(point p; output float f1; output float f2; output float id;) {
    point corner = point(floor(xcomp(p)), floor(ycomp(p)), floor(zcomp(p)));
    f1 = 100;
    f2 = 100;
    id = 0;
    uniform float i, j, k;
    for (i = -1; i <= 1; i += 1)
        for (j = -1; j <= 1; j += 1)
            for (k = -1; k <= 1; k += 1) {
                point cell = corner + vector(i, j, k) + vector(0.5, 0.5, 0.5);
                point seed = cell + (vector cellnoise(cell) - vector(0.5, 0.5, 0.5));
                float d = distance(seed, p);
                if (d < f1) {
                    f2 = f1;
                    f1 = d;
                    id = float cellnoise(cell + vector(17, 5, 31));
                } else if (d < f2)
                    f2 = d;
            }
}

surface granite(float Ka = 1; float Kd = 0.8; float Ks = 0.45; float roughness = 0.05;
                float scale = 15; float mica = 0.17;
                color quartzcolor = color(0.52, 0.50, 0.48);
                color feldsparcolor = color(0.60, 0.38, 0.31);
                color micacolor = color(0.05, 0.05, 0.055);) {
    normal Nf = faceforward(normalize(N), I);
    vector V = -normalize(I);
    point Q = scale * transform("shader", P);
    Q += 0.5 * (vector noise(1.3 * Q) - vector(0.5, 0.5, 0.5));

    float f1, f2, grain;
    nearest_grain(Q, f1, f2, grain);
    float blur = clamp(scale * sqrt(area(P)), 0.02, 1);
    float inside = smoothstep(0, 0.06 + 0.5 * blur, f2 - f1);

    color Ct = mix(quartzcolor, feldsparcolor, step(0.62, grain));
    Ct *= 0.8 + 0.4 * float noise(6 * Q);
    Ct = mix(Ct, micacolor, step(1 - mica, grain));
    Ct *= 0.75 + 0.25 * inside;
    float flecks = smoothstep(0.66, 0.72, float noise(2.7 * Q + vector(9, 2, 5)));
    Ct = mix(Ct, micacolor, 0.7 * flecks);

    float glint = mix(1, 0.35, step(1 - mica, grain));
    Oi = Os;
    Ci = Os * (Cs * Ct * (Ka * ambient() + Kd * diffuse(Nf)) +
               Ks * glint * specular(Nf, V, 8 * roughness));
}
