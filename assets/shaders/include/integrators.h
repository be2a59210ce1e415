// integrators.h: light of a class by methods evaluateSamples() and generateSamples(), its own or
// those of another shader. A source that calls directlighting() or indirectspecular() has it without
// an #include; these functions become methods of its class.
#ifndef KINORA_INTEGRATORS_H
#define KINORA_INTEGRATORS_H

#include <stdrsl/radiancesample.h>

float integrate_listed(shader list[]; shader one;) {
    float i;
    for (i = 0; i < arraylength(list); i += 1)
        if (list[i] == one) return 1;
    return 0;
}

// One sample for each light of the category that passes the test: what its light() sends, of weight
// 1. There is nothing to weigh, so the hints of directlighting(), which come behind what is special
// to a form, change nothing. OF: nothing, or the other shader and an arrow.
#define KINORA_DIRECT(NAME, FIRST_FORMALS, LAST_FORMALS, OF, BEFORE, TEST)                     \
    color NAME(FIRST_FORMALS color hints; string category; uniform float diffuse_part;         \
               uniform float specular_part; output color diffuseresult;                        \
               output color specularresult; output color irradianceresult;                     \
               output color unshadoweddiffuse; output color unshadowedspecular;                \
               LAST_FORMALS) {                                                                 \
        color matte = 0, shine = 0, irradiance = 0;                                            \
        __radiancesample one[1];                                                               \
        BEFORE                                                                                 \
        illuminance(category, P) {                                                             \
            if (TEST) {                                                                        \
                vector towards = normalize(L);                                                 \
                irradiance += Cl * max(0, towards . normalize(N));                             \
                if (diffuse_part != 0) {                                                       \
                    one[0]->reinit();                                                          \
                    one[0]->setLightSample(Cl, 1, towards, length(L));                         \
                    OF evaluateSamples("diffuse", one);                                        \
                    matte += Cl * one[0]->materialResponse;                                    \
                }                                                                              \
                if (specular_part != 0) {                                                      \
                    one[0]->reinit();                                                          \
                    one[0]->setLightSample(Cl, 1, towards, length(L));                         \
                    OF evaluateSamples("specular", one);                                       \
                    shine += Cl * one[0]->materialResponse;                                    \
                }                                                                              \
            }                                                                                  \
        }                                                                                      \
        diffuseresult = matte;                                                                 \
        specularresult = shine;                                                                \
        irradianceresult = irradiance;                                                         \
        unshadoweddiffuse = matte;                                                             \
        unshadowedspecular = shine;                                                            \
        return matte + shine;                                                                  \
    }
// Leaves the material's samples to a later indirectspecular(); those that are there are kept.
#define KINORA_DIRECT_FORMS(NAME, KEEPING, FORMALS, OF, TEST)                                  \
    KINORA_DIRECT(NAME, FORMALS, , OF, , TEST)                                                 \
    KINORA_DIRECT(KEEPING, FORMALS, output __radiancesample materialsamples[];, OF,            \
                  if (arraylength(materialsamples) == 0)                                       \
                      OF generateSamples("specular", materialsamples);                         \
                  , TEST)
KINORA_DIRECT_FORMS(integrate_direct, integrate_direct_keeping, , , 1 != 0)
KINORA_DIRECT_FORMS(integrate_direct_among, integrate_direct_among_keeping, shader among[];, ,
                    integrate_listed(among, lighthandle()) != 0)
KINORA_DIRECT_FORMS(integrate_direct_of, integrate_direct_of_keeping, shader which;, which->,
                    1 != 0)
KINORA_DIRECT_FORMS(integrate_direct_of_among, integrate_direct_of_among_keeping,
                    shader which; shader among[];, which->,
                    integrate_listed(among, lighthandle()) != 0)
#undef KINORA_DIRECT_FORMS
#undef KINORA_DIRECT

// The mean over the samples of response / pdf x traced light. A pdf or a direction of 0: no ray.
#define KINORA_INDIRECT(NAME, FORMALS, OF)                                                     \
    color NAME(FORMALS color hints; float maxdist; output __radiancesample materialsamples[];) { \
        if (arraylength(materialsamples) == 0)                                                 \
            OF generateSamples("indirectspecular", materialsamples);                           \
        color sum = 0;                                                                         \
        float i, count = arraylength(materialsamples);                                         \
        for (i = 0; i < count; i += 1) {                                                       \
            vector towards = materialsamples[i]->direction;                                    \
            float pdf = materialsamples[i]->materialPdf;                                       \
            if (pdf > 0 && towards . towards > 0)                                              \
                sum += materialsamples[i]->materialResponse / pdf *                            \
                       color trace(P, towards, "maxdist", maxdist);                            \
        }                                                                                      \
        return sum / max(1, count);                                                            \
    }
KINORA_INDIRECT(integrate_indirect_keeping, , )
KINORA_INDIRECT(integrate_indirect_of_keeping, shader which;, which->)
#undef KINORA_INDIRECT

color integrate_indirect(color hints; float maxdist;) {
    __radiancesample samples[];
    return integrate_indirect_keeping(hints, maxdist, samples);
}
color integrate_indirect_of(shader which; color hints; float maxdist;) {
    __radiancesample samples[];
    return integrate_indirect_of_keeping(which, hints, maxdist, samples);
}

#endif
