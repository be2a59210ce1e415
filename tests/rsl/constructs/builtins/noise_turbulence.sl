// sums of octaves with filtered abs
#define snoise(p) (2 * float noise(p) - 1)
float turb(point p; float octaves) {
    float i, sum = 0, scale = 1;
    point q = p;
    for (i = 0; i < octaves; i += 1) { sum += abs(snoise(q)) * scale; q *= 2; scale *= 0.5; }
    return sum;
}
surface noise_turbulence(float octaves = 4) { Ci = turb(transform("shader", P), octaves) * Cs; }
