/* cloudysun.sl: a sun whose light clouds dim as they pass.
   Parameters: intensity, sun, shade, cover (0 to 1), scale, wind (in the light's space). */
class cloudysun(float intensity = 1.7; color sun = color(1, 0.93, 0.8); color shade = color(0.35, 0.45, 0.65);
                float cover = 0.5; float scale = 1.4; vector wind = vector "shader" (0.1, 0, 0);) {
    float cloud(point Q) {
        float k, sum = 0, weight = 0.5;
        point q = Q;
        for (k = 0; k < 5; k += 1) {
            sum += weight * float noise(q);
            q = 2.2 * q + vector(3, 1, 2);
            weight *= 0.5;
        }
        return smoothstep(0.62 - 0.3 * cover, 0.8 - 0.3 * cover, sum);
    }
    public void light(output vector L; output color Cl) {
        solar(vector "shader" (0, 0, 1), 0) {
            point Q = transform("shader", Ps);
            float dim = cloud(scale * point(Q[0], Q[1], 0) + time * vtransform("shader", wind));
            Cl = intensity * mix(sun, 0.3 * shade, dim);
        }
    }
}
