// lightsamples.h: what the renderer runs of a light that has generateSamples() and
// evaluateSamples(): these functions become methods of its class. A source that has such methods has
// it without an #include.
//
// Asked for samples, a light generates as many as it likes; asked for a direction, it evaluates one.
// Its own shadowSamples(), if it has that, takes the place of the renderer's shadow rays.
#ifndef KINORA_LIGHTSAMPLES_H
#define KINORA_LIGHTSAMPLES_H

#include <stdrsl/radiancesample.h>

#define KINORA_LIGHT_SAMPLES(NAME, SHADOW)                                                     \
    void NAME() {                                                                              \
        __radiancesample samples[];                                                            \
        string domain = samplewishdomain();                                                    \
        if (samplewish() == 0) {                                                               \
            generateSamples(domain, samples);                                                  \
        } else {                                                                               \
            resize(samples, 1);                                                                \
            samples[0]->direction = samplewishdirection();                                     \
            samples[0]->distance = 1e30;                                                       \
            samples[0]->origin = Ps;                                                           \
            evaluateSamples(domain, samples);                                                  \
        }                                                                                      \
        SHADOW                                                                                 \
        float i, count = arraylength(samples);                                                 \
        for (i = 0; i < count; i += 1)                                                         \
            lightsample(samples[i]->direction, samples[i]->distance, samples[i]->radiance,     \
                        samples[i]->lightPdf, count);                                          \
    }
KINORA_LIGHT_SAMPLES(lightsamples_sent, )
KINORA_LIGHT_SAMPLES(lightsamples_sent_shadowed, shadowSamples(samples);)
#undef KINORA_LIGHT_SAMPLES

#endif
