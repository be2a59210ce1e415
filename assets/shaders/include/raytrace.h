// raytrace.h: reflections by rays, blurred by several of them.
#ifndef RAYTRACE_H
#define RAYTRACE_H

// What a cone of `nsamples` rays sees, times Kr; the axis of the cone is Rdir, its width blur.
color RayTrace(point P; vector Rdir; float Kr, blur; uniform float jitter, nsamples; output float alpha) {
    color sum = 0;
    alpha = 0;
    if (Kr > 0.001) {
        vector R = normalize(Rdir);
        vector across = normalize(R ^ (abs(xcomp(R)) < 0.9 ? vector(1, 0, 0) : vector(0, 1, 0)));
        vector up = across ^ R;
        uniform float n = max(1, nsamples), i;
        for (i = 0; i < n; i += 1) {
            float angle = 2 * PI * (i + jitter * random()) / n, radius = blur * sqrt((i + 0.5) / n);
            sum += trace(P, R + radius * (cos(angle) * across + sin(angle) * up));
        }
        sum *= Kr / n;
        alpha = 1;
    }
    return sum;
}
color RayTrace(point P; vector Rdir; float Kr, blur; uniform float jitter; output float alpha) {
    return RayTrace(P, Rdir, Kr, blur, jitter, blur > 0 ? 16 : 1, alpha);
}

#endif
