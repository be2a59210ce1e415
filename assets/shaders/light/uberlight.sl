/* uberlight.sl: a lamp for film sets: a superelliptic beam with soft borders, cuton and cutoff with
   distance, a falloff of any power, coloured shadows left to the renderer, noise as drifting haze.
   Parameters: intensity; width, height, wedge, hedge, roundness (the beam's section at distance 1);
   cuton, cutoff, nearedge, faredge; falloff, falloffdist; beamdistribution; slidenoise and its
   frequency and speed; nonspecular, nondiffuse in 0..1. */
light uberlight(float intensity = 1.5; color lightcolor = color(1, 0.94, 0.82);
                string lighttype = "spot";
                float cuton = 0.01; float cutoff = 1e6; float nearedge = 0; float faredge = 0;
                float falloff = 2; float falloffdist = 4; float maxintensity = 8;
                float beamdistribution = 1;
                float width = 0.34; float height = 0.26; float wedge = 0.08; float hedge = 0.08;
                float roundness = 0.6;
                float noiseamp = 0.7; float noisefreq = 3;
                output float __nonspecular = 0; output float __nondiffuse = 0;
                output string __category = "key,uber";) {
    /* 1 inside the smaller superellipse, 0 outside the larger, smooth between: in a quadrant. */
    float superellipse(float x; float y; uniform float a; uniform float b; uniform float A;
                       uniform float B; uniform float round) {
        float result = 0;
        float px = abs(x);
        float py = abs(y);
        if (round < 0.00001) {
            result = (1 - smoothstep(a, A, px)) * (1 - smoothstep(b, B, py));
        } else {
            uniform float e = 2 / round;
            float inner = pow(pow(px / a, e) + pow(py / b, e), -1 / e);
            float outer = pow(pow(px / A, e) + pow(py / B, e), -1 / e);
            if (inner >= 1)
                result = 1;
            else if (outer > 1)
                result = smoothstep(0, 1, (outer - 1) / (outer - inner));
        }
        return result;
    }
    /* Where the point is in the beam's own space: z away from the lamp. */
    point Q = transform("shader", Ps);
    point haze = Q;
    setzcomp(haze, -zcomp(Q));
    float away = zcomp(Q);
    float depthways = distance(Q, point(0, 0, 0));
    if (lighttype == "omni")
        away = depthways;

    float atten = smoothstep(cuton - nearedge, cuton + 0.0001, away);
    atten *= 1 - smoothstep(cutoff, cutoff + faredge + 0.0001, away);
    if (falloff != 0) {
        /* Beyond falloffdist a power of the distance; nearer a smooth rise to maxintensity. */
        if (depthways > falloffdist)
            atten *= pow(falloffdist / depthways, falloff);
        else {
            uniform float s0 = log(1 / maxintensity);
            uniform float beta = -falloff / s0;
            atten *= maxintensity * exp(s0 * pow(depthways / falloffdist, beta));
        }
    }
    if (lighttype == "spot") {
        float x = xcomp(Q) / max(away, 0.0001);
        float y = ycomp(Q) / max(away, 0.0001);
        if (away > 0)
            atten *= superellipse(x, y, width, height, width + wedge, height + hedge, roundness);
        else
            atten = 0;
        atten *= pow(max(away / depthways, 0), beamdistribution);
    }
    if (noiseamp > 0) {
        float n = float noise(noisefreq * haze + vector(0, 0, 0.4 * time));
        n = smoothstep(0, 1, 0.5 + noiseamp * (n - 0.5));
        atten *= 0.5 + n;
    }
    illuminate(point "shader" (0, 0, 0)) {
        Cl = atten * intensity * lightcolor;
    }
}
