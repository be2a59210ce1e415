// locillum.h: how surfaces reflect lights: loops over the lights, beside diffuse() and specular().
#ifndef LOCILLUM_H
#define LOCILLUM_H

// Rough clay-like reflection (Oren and Nayar 1994, the qualitative model); roughness in radians.
color LocIllumOrenNayar(normal N; vector V; float roughness) {
    float s2 = roughness * roughness;
    float A = 1 - 0.5 * s2 / (s2 + 0.33), B = 0.45 * s2 / (s2 + 0.09);
    float cosr = V . N, thetar = acos(clamp(cosr, -1, 1));
    vector Vp = normalize(V - N * cosr);
    color sum = 0;
    uniform float nondiff = 0;
    illuminance(P, N, PI / 2) {
        nondiff = 0;
        lightsource("__nondiffuse", nondiff);
        if (nondiff < 1) {
            vector Ln = normalize(L);
            float cosi = Ln . N, thetai = acos(clamp(cosi, -1, 1));
            float cosphi = Vp . normalize(Ln - N * cosi);
            float a = max(thetai, thetar), b = min(thetai, thetar);
            sum += (1 - nondiff) * Cl * cosi * (A + B * max(0, cosphi) * sin(a) * tan(b));
        }
    }
    return sum;
}

// A highlight with an edge: specular() pushed through a step that `sharpness` makes hard (0..1).
color LocIllumGlossy(normal N; vector V; float roughness, sharpness) {
    float w = 0.18 * (1 - clamp(sharpness, 0, 0.99));
    color sum = 0;
    uniform float nonspec = 0;
    illuminance(P, N, PI / 2) {
        nonspec = 0;
        lightsource("__nonspecular", nonspec);
        if (nonspec < 1) {
            vector H = normalize(normalize(L) + V);
            float lobe = pow(max(0, N . H), 1 / (roughness / 8));
            sum += (1 - nonspec) * Cl * smoothstep(0.72 - w, 0.72 + w, lobe);
        }
    }
    return sum;
}

// Highlights that are longer across the brushing (Ward 1992); xdir is the direction of brushing.
color LocIllumWardAnisotropic(normal N; vector V; vector xdir; float xroughness, yroughness) {
    float cosr = clamp(N . V, 0.0001, 1);
    vector X = normalize(xdir - N * (xdir . N)), Y = N ^ X;
    color sum = 0;
    uniform float nonspec = 0;
    illuminance(P, N, PI / 2) {
        nonspec = 0;
        lightsource("__nonspecular", nonspec);
        if (nonspec < 1) {
            vector Ln = normalize(L), H = normalize(V + Ln);
            float cosi = Ln . N;
            float rho = exp(-2 * (sqr_of(X . H / xroughness) + sqr_of(Y . H / yroughness)) / (1 + H . N)) /
                        (4 * PI * xroughness * yroughness * sqrt(max(cosi * cosr, 0.0001)));
            sum += (1 - nonspec) * Cl * cosi * rho;
        }
    }
    return sum;
}
float sqr_of(float x) { return x * x; }

#endif
