// prman.h: functions of PRMan that are made of others. A source that calls one of them has it
// without an #include.
#ifndef KINORA_PRMAN_H
#define KINORA_PRMAN_H

// The error function to 2e-7: Abramowitz and Stegun 7.1.26.
float erf(float x) {
    float k = 1 / (1 + 0.3275911 * abs(x));
    float sum = ((((1.061405429 * k - 1.453152027) * k + 1.421413741) * k - 0.284496736) * k +
                 0.254829592) * k;
    return sign(x) * (1 - sum * exp(-x * x));
}
float erfc(float x) { return 1 - erf(x); }

// 1 where the value is 0 everywhere in the grid. No result depends on grids here: it is the point's
// own.
float gridnever(float x) { return x == 0 ? 1 : 0; }

// Elements first to last - 1 become points of the unit square, one in each of as many columns.
void randomstrat(float first; float last; output vector samples[]) {
    float i, count = last - first;
    for (i = first; i < last; i += 1)
        samples[i] = vector "current" ((i - first + random()) / count, random(), 0);
}

// Noise of a band: where a cell of the lattice is smaller than the filter, noise() fades to its mean.
// PRMan's is made of wavelets (Cook and DeRose 2005), whose values differ.
#define KINORA_WNOISE(TYPE, FORMAL, NAME, MEAN)                                      \
    TYPE wnoise(FORMAL NAME; float width = 0;) {                                     \
        return mix(TYPE noise(NAME), TYPE MEAN, smoothstep(0.5, 1, width));          \
    }
KINORA_WNOISE(float, float, x, 0.5)
KINORA_WNOISE(color, float, x, 0.5)
KINORA_WNOISE(float, point, q, 0.5)
KINORA_WNOISE(color, point, q, 0.5)
KINORA_WNOISE(point, point, q, 0.5)
KINORA_WNOISE(vector, point, q, 0.5)
#undef KINORA_WNOISE

#endif
