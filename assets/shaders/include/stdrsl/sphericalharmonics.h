// stdrsl/SphericalHarmonics.h: light from all around as the first nine real spherical harmonics
// (Ramamoorthi and Hanrahan 2001). Axes are those of the space that the coefficients are given in.
#ifndef STDRSL_SPHERICALHARMONICS_H
#define STDRSL_SPHERICALHARMONICS_H

#include <stdrsl/math.h>
#include <stdrsl/shadingcontext.h>

// Number k of the harmonics in a direction of length 1: l, m = 0,0 1,-1 1,0 1,1 2,-2 ... 2,2.
float stdrsl_harmonic(float k; float x; float y; float z;) {
    if (k == 0) return 0.28209479;
    if (k == 1) return 0.48860251 * y;
    if (k == 2) return 0.48860251 * z;
    if (k == 3) return 0.48860251 * x;
    if (k == 4) return 1.0925484 * x * y;
    if (k == 5) return 1.0925484 * y * z;
    if (k == 6) return 0.31539157 * (3 * z * z - 1);
    if (k == 7) return 1.0925484 * x * z;
    return 0.54627421 * (x * x - y * y);
}

struct stdrsl_SphericalHarmonic {
    color m_coefficients[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};

    // One band, two or three: 1, 4 or 9 coefficients; further ones are left out.
    void createFromArray(color given[]) {
        float k;
        for (k = 0; k < 9; k += 1) m_coefficients[k] = k < arraylength(given) ? given[k] : color 0;
    }
    void createFromArray(float given[]) {
        float k;
        for (k = 0; k < 9; k += 1)
            m_coefficients[k] = k < arraylength(given) ? color(given[k]) : color 0;
    }
    // The light that comes from a direction of length 1.
    color evaluate(vector w) {
        color sum = 0;
        float k;
        for (k = 0; k < 9; k += 1)
            sum += m_coefficients[k] * stdrsl_harmonic(k, w[0], w[1], w[2]);
        return sum;
    }
    // From the named space to "current". The corners of an icosahedron are a spherical 5-design, so
    // that their mean is the exact integral of a product of two of these functions.
    void rotate(string space) {
        float golden = 0.5 * (1 + sqrt(5)), scale = inversesqrt(1 + golden * golden);
        color turned[9] = {0, 0, 0, 0, 0, 0, 0, 0, 0};
        float corner, k;
        for (corner = 0; corner < 12; corner += 1) {
            float a = mod(corner, 2) < 1 ? scale : -scale;
            float b = (mod(corner, 4) < 2 ? scale : -scale) * golden;
            float axis = floor(corner / 4);
            vector w = axis == 0   ? vector "current" (0, a, b)
                       : axis == 1 ? vector "current" (a, b, 0)
                                   : vector "current" (b, 0, a);
            color light = evaluate(normalize(vtransform(space, w)));
            for (k = 0; k < 9; k += 1)
                turned[k] += light * stdrsl_harmonic(k, w[0], w[1], w[2]) * (M_FOURPI / 12);
        }
        m_coefficients = turned;
    }
    // The integral over all directions of this times the other.
    color convolve(stdrsl_SphericalHarmonic other; float unused;) {
        color sum = 0;
        float k;
        for (k = 0; k < 9; k += 1) sum += m_coefficients[k] * other->m_coefficients[k];
        return sum;
    }
};

#endif
