/* incense.sl: drifting smoke, marched through: density is turbulence in world space, and every step
   is lit by the lamps, so that beams show.
   Parameters: density, stepsize and maxsteps of the march, scale, wind (units a second), the smoke's
   colour, ground (height where it thins out). */
volume incense(float density = 0.7; float stepsize = 0.5; float maxsteps = 40; float scale = 0.55;
             float ground = 3; vector wind = vector "world" (0.3, 0.1, 0.05);
             color smokecolor = color(0.75, 0.76, 0.80);) {
    float thick(point p) {
        point q = scale * transform("world", p) - scale * time * vtransform("world", wind);
        float value = 0;
        float weight = 0.6;
        uniform float octave;
        for (octave = 0; octave < 4; octave += 1) {
            value += weight * float noise(q);
            q = 2.1 * q + vector(3, 1, 7);
            weight *= 0.5;
        }
        float height = zcomp(transform("world", p));
        return smoothstep(0.46, 0.66, value) * (1 - smoothstep(0.3 * ground, ground, height));
    }
    float way = length(I);
    float steps = clamp(ceil(way / stepsize), 1, maxsteps);
    vector forward = I / steps;
    float pace = way / steps;
    point p = P - I + forward * float random();
    color gathered = 0;
    float left = 1;
    float k;
    for (k = 0; k < steps; k += 1) {
        float rho = density * thick(p);
        if (rho > 0.0005) {
            color light = 0;
            illuminance(p) {
                light += Cl;
            }
            float stopped = 1 - exp(-rho * pace);
            gathered += left * stopped * smokecolor * light;
            left *= 1 - stopped;
            if (left < 0.01)
                break;
        }
        p += forward;
    }
    Ci = Ci * left + gathered;
    Oi = Oi * left + (1 - left);
}
