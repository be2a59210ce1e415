/* sunsky.sl: a clear sky and the sun in it, whose disc is half a degree wide. The sky's colors are
   those of A. Preetham, P. Shirley and B. Smits, A Practical Analytic Model for Daylight, 1999; the
   sun's is what the air leaves of it there. Half of the samples go to the sun. The light's y is up.
   Parameters: intensity, elevation and azimuth of the sun in degrees (from where the light looks, to
   the left), turbidity (2: very clear, 10: hazy), groundcolor (what the ground sends up), sun (what
   its light is multiplied by), samples (of each lit point; 0: as many as the renderer
   takes of a lamp). */
class sunsky(uniform float intensity = 1; uniform float elevation = 35; uniform float azimuth = 60;
             uniform float turbidity = 3; uniform color groundcolor = color(0.16, 0.15, 0.13);
             uniform float sun = 1; uniform float samples = 0; output float __environment = 1;) {
    constant float kHalfAngle = 0.00465;
    constant float kUnit = 0.06;       // of a thousand candela per square metre
    constant float kOutside = 1.88e6;  // what the sun has of these before the air
    constant float kUpper = 0.75;      // of the sky's samples

    uniform vector ahead = normalize(vector "shader" (0, 0, 1));
    uniform vector side = vector "shader" (1, 0, 0);
    uniform vector right = normalize(side - (side . ahead) * ahead);
    uniform vector top = vector "shader" (0, 1, 0);
    uniform vector up = normalize(top - (top . ahead) * ahead - (top . right) * right);

    uniform float T = clamp(turbidity, 2, 10);
    uniform float height = radians(elevation), turn = radians(azimuth);
    uniform vector to_sun = sin(height) * up + cos(height) * (cos(turn) * ahead - sin(turn) * right);
    uniform float zenith = PI / 2 - clamp(height, 0, PI / 2);  // angle of the sun to it
    constant float sine2 = kHalfAngle * kHalfAngle;  // of the disc's edge
    constant float sunpdf = 1 / (PI * sine2);

    /* Perez' function of the angles to the zenith and to the sun. */
    float perez(float A, B, C, D, E, cosine, angle;) {
        float c = cos(angle);
        return (1 + A * exp(B / max(cosine, 0.01))) * (1 + C * exp(D * angle) + E * c * c);
    }
    float share(float A, B, C, D, E, cosine, angle;) {
        return perez(A, B, C, D, E, cosine, angle) / perez(A, B, C, D, E, 1, zenith);
    }
    float cubic(float a, b, c, d;) { return ((a * zenith + b) * zenith + c) * zenith + d; }

    color sky(float cosine, angle;) {
        float Y = (4.0453 * T - 4.971) * tan((4 / 9 - T / 120) * (PI - 2 * zenith)) - 0.2155 * T + 2.4192;
        float x = T * T * cubic(0.00166, -0.00375, 0.00209, 0) +
                  T * cubic(-0.02903, 0.06377, -0.03202, 0.00394) +
                  cubic(0.11693, -0.21196, 0.06052, 0.25886);
        float y = T * T * cubic(0.00275, -0.0061, 0.00317, 0) +
                  T * cubic(-0.04214, 0.0897, -0.04153, 0.00516) +
                  cubic(0.15346, -0.26756, 0.0667, 0.26688);
        Y *= share(0.1787 * T - 1.463, -0.3554 * T + 0.4275, -0.0227 * T + 5.3251,
                   0.1206 * T - 2.5771, -0.067 * T + 0.3703, cosine, angle);
        x *= share(-0.0193 * T - 0.2592, -0.0665 * T + 0.0008, -0.0004 * T + 0.2125,
                   -0.0641 * T - 0.8989, -0.0033 * T + 0.0452, cosine, angle);
        y *= share(-0.0167 * T - 0.2608, -0.095 * T + 0.0092, -0.0079 * T + 0.2102,
                   -0.0441 * T - 1.6537, -0.0109 * T + 0.0529, cosine, angle);
        float X = x / y * Y, Z = (1 - x - y) / y * Y;
        color c = color(3.2406 * X - 1.5372 * Y - 0.4986 * Z, -0.9689 * X + 1.8758 * Y + 0.0415 * Z,
                        0.0557 * X - 0.204 * Y + 1.057 * Z);
        return kUnit * max(c, color(0));
    }

    /* What the air lets through of light of that wavelength, in thousandths of a millimetre. */
    float passing(float wave, mass;) {
        float haze = 0.04608 * T - 0.04586;
        return exp(-mass * (0.008735 * pow(wave, -4.08) + haze * pow(wave, -1.3)));
    }
    color disc() {
        float mass = 1 / (sin(height) + 0.15 * pow(3.885 + elevation, -1.253));
        color c = color(passing(0.61, mass), passing(0.55, mass), passing(0.465, mass));
        return elevation > 0 ? sun * kOutside * kUnit * c : color(0);
    }

    /* By the sine, which tells small angles apart. */
    float in_disc(vector D) {
        vector across = D ^ to_sun;
        return D . to_sun > 0 && across . across <= 1.0001 * sine2 ? 1 : 0;
    }
    color light_along(vector D) {
        float cosine = D . up;
        color c = groundcolor;
        if (cosine > 0) c = sky(cosine, acos(clamp(D . to_sun, -1, 1)));
        c += in_disc(D) * disc();
        return intensity * c;
    }
    float density_along(vector D) {
        float share = D . up > 0 ? kUpper : 1 - kUpper;
        return 0.5 * share / (2 * PI) + 0.5 * sunpdf * in_disc(D);
    }
    vector about(vector axis; float sine, cosine, turn;) {
        vector a = normalize(abs(axis[0]) < 0.9 ? axis ^ vector(1, 0, 0) : axis ^ vector(0, 1, 0));
        vector b = axis ^ a;
        return cosine * axis + sine * (cos(turn) * a + sin(turn) * b);
    }
    vector chosen(float x, y;) {
        vector D = to_sun;
        if (x < 0.5) {
            float sine = kHalfAngle * sqrt(2 * x);
            D = about(to_sun, sine, sqrt(1 - sine * sine), 2 * PI * y);
        } else {
            float of_sky = 2 * x - 1;
            float cosine = of_sky < kUpper ? of_sky / kUpper : (kUpper - of_sky) / (1 - kUpper);
            D = about(up, sqrt(max(0, 1 - cosine * cosine)), cosine, 2 * PI * y);
        }
        return D;
    }

    public void generateSamples(string what; output __radiancesample s[]) {
        uniform float i, n = samples;
        if (n == 0) rayinfo("lampsamples", n);
        resize(s, n);
        for (i = 0; i < n; i += 1) {
            float x = random(), y = random();
            vector D = chosen(x, y);
            s[i]->setLightSample(light_along(D), density_along(D), D, 1e30);
        }
    }
    public void evaluateSamples(string what; output __radiancesample s[]) {
        uniform float i;
        for (i = 0; i < arraylength(s); i += 1) {
            vector D = normalize(s[i]->direction);
            s[i]->setLightSample(light_along(D), density_along(D));
        }
    }
}
