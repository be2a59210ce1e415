// normals.h: the normal to shade with.
#ifndef NORMALS_H
#define NORMALS_H

// N normalised, and turned to the viewer unless the surface shows one side only.
normal shadingnormal(normal N) {
    normal Nn = normalize(N);
    uniform float sides = 2;
    attribute("Sides", sides);
    if (sides == 2) Nn = faceforward(Nn, I, Nn);
    return Nn;
}

#endif
