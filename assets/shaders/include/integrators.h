// integrators.h: light of a class by its own methods evaluateSamples() and generateSamples(). A
// source that calls directlighting() or indirectspecular() has it without an #include; these
// functions become methods of its class.
#ifndef KINORA_INTEGRATORS_H
#define KINORA_INTEGRATORS_H

#include <stdrsl/radiancesample.h>

// One sample for each light of the category: what its light() sends, of weight 1. There is nothing
// to weigh, so the hints of directlighting(), which come first, change nothing.
color integrate_direct(color hints; string category; uniform float diffuse_part;
                       uniform float specular_part; output color diffuseresult;
                       output color specularresult; output color irradianceresult;
                       output color unshadoweddiffuse; output color unshadowedspecular;) {
    color matte = 0, shine = 0, irradiance = 0;
    __radiancesample one[1];
    illuminance(category, P) {
        vector towards = normalize(L);
        irradiance += Cl * max(0, towards . normalize(N));
        if (diffuse_part != 0) {
            one[0]->reinit();
            one[0]->setLightSample(Cl, 1, towards, length(L));
            evaluateSamples("diffuse", one);
            matte += Cl * one[0]->materialResponse;
        }
        if (specular_part != 0) {
            one[0]->reinit();
            one[0]->setLightSample(Cl, 1, towards, length(L));
            evaluateSamples("specular", one);
            shine += Cl * one[0]->materialResponse;
        }
    }
    diffuseresult = matte;
    specularresult = shine;
    irradianceresult = irradiance;
    unshadoweddiffuse = matte;
    unshadowedspecular = shine;
    return matte + shine;
}

// Leaves the material's samples to a later indirectspecular(); those that are there are kept.
color integrate_direct_keeping(color hints; string category; uniform float diffuse_part;
                               uniform float specular_part; output color diffuseresult;
                               output color specularresult; output color irradianceresult;
                       output color unshadoweddiffuse; output color unshadowedspecular;
                               output __radiancesample materialsamples[];) {
    if (arraylength(materialsamples) == 0) generateSamples("specular", materialsamples);
    return integrate_direct(hints, category, diffuse_part, specular_part, diffuseresult,
                            specularresult, irradianceresult, unshadoweddiffuse,
                            unshadowedspecular);
}

// The mean over the samples of response / pdf x traced light. A pdf or a direction of 0: no ray.
color integrate_indirect_keeping(color hints; float maxdist;
                                 output __radiancesample materialsamples[];) {
    if (arraylength(materialsamples) == 0) generateSamples("indirectspecular", materialsamples);
    color sum = 0;
    float i, count = arraylength(materialsamples);
    for (i = 0; i < count; i += 1) {
        vector towards = materialsamples[i]->direction;
        float pdf = materialsamples[i]->materialPdf;
        if (pdf > 0 && towards . towards > 0)
            sum += materialsamples[i]->materialResponse / pdf *
                   color trace(P, towards, "maxdist", maxdist);
    }
    return sum / max(1, count);
}

color integrate_indirect(color hints; float maxdist;) {
    __radiancesample samples[];
    return integrate_indirect_keeping(hints, maxdist, samples);
}

#endif
