// reflections.h: reflections out of environment and reflection maps, or by rays without a map.
#ifndef REFLECTIONS_H
#define REFLECTIONS_H

#include "raytrace.h"

// The map, the space it is in, and the radius of the sphere it stands for (0: infinitely far).
#define ENVPARAMS envname, envspace, envrad
#define DECLARE_ENVPARAMS uniform string envname, envspace; uniform float envrad
#define DECLARE_DEFAULTED_ENVPARAMS \
    uniform string envname = "", envspace = "world"; uniform float envrad = 100

// The map seen from P in direction R, with the parallax of a sphere of radius envrad.
color Environment(uniform string envname, envspace; uniform float envrad; point P; vector R; float blur;
                  output float alpha) {
    vector direction = normalize(vtransform(envspace, R));
    if (envrad > 0) {
        vector from = vector transform(envspace, P);
        float along = from . direction, inside = envrad * envrad - from . from + along * along;
        direction = normalize(from + direction * (sqrt(max(inside, 0)) - along));
    }
    alpha = 1;
    return color environment(envname, direction, "blur", blur);
}

// A picture of the mirrored scene, seen in raster position.
color ReflMap(uniform string reflname; point P; float blur; output float alpha) {
    point ndc = transform("NDC", P);
    alpha = 1;
    return color texture(reflname, xcomp(ndc), ycomp(ndc), "blur", blur);
}

// A map if one is named ("reflection" of the screen or environment), else rays; times Kr.
color SampleEnvironment(point P; vector R; float Kr, blur; DECLARE_ENVPARAMS) {
    color seen = 0;
    float alpha = 0;
    if (Kr > 0.001) {
        if (envname == "")
            seen = RayTrace(P, R, 1, blur, 1, alpha);
        else if (envspace == "NDC")
            seen = ReflMap(envname, P, blur, alpha);
        else
            seen = Environment(envname, envspace, envrad, P, R, blur, alpha);
    }
    return Kr * seen;
}

#endif
