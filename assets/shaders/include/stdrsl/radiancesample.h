// stdrsl/RadianceSample.h: a direction with the light that comes from it and what becomes of it.
// The struct is known without the header.
#ifndef STDRSL_RADIANCESAMPLE_H
#define STDRSL_RADIANCESAMPLE_H

struct __radiancesample {
    varying vector direction = 0;  // of length 1, away from the point
    varying float distance = 1e30;
    varying point origin = 0;
    varying color radiance = 0;
    varying float lightPdf = 0;  // of solid angle; 0: the light was not sampled
    varying color materialResponse = 0;
    varying float materialPdf = 0;
    varying color accumulatedMaterialResponse = 0;
    varying float accumulatedMaterialPdf = 0;
    varying float valid = 1;  // 0 in what resize() has made, until something is set

    void setRadiance(color c) {
        radiance = c;
        valid = 1;
    }
    void setLightSample(color c; float pdf) {
        setRadiance(c);
        lightPdf = pdf;
    }
    void setLightSample(color c; float pdf; vector towards; float far) {
        setLightSample(c, pdf);
        direction = towards;
        distance = far;
    }
    void setLightSamples(color c; float pdf; vector towards; float far) {
        setLightSample(c, pdf, towards, far);
    }
    void setMaterialResponse(color response; float pdf) {
        materialResponse = response;
        materialPdf = pdf;
        valid = 1;
    }
    void setMaterialSample(color response; float pdf; vector towards; float far) {
        setMaterialResponse(response, pdf);
        direction = towards;
        distance = far;
    }
    void setMaterialSamples(color response; float pdf; vector towards; float far) {
        setMaterialSample(response, pdf, towards, far);
    }
    void reinit() {
        radiance = 0;
        lightPdf = 0;
        materialResponse = 0;
        materialPdf = 0;
        accumulatedMaterialResponse = 0;
        accumulatedMaterialPdf = 0;
    }
};

struct stdrsl_RadianceSample {
    // Lobe k holds counts[k] samples of them all: the response of each becomes that of one sampling.
    void normalizeMaterialResponse(output __radiancesample samples[]; float counts[]) {
        float total = arraylength(samples), at = 0, k, i;
        for (k = 0; k < arraylength(counts); k += 1) {
            for (i = 0; i < counts[k]; i += 1) {
                if (at < total) samples[at]->materialResponse *= total / counts[k];
                at += 1;
            }
        }
    }
    void accumulateMaterialResponse(output __radiancesample samples[]) {
        float i;
        for (i = 0; i < arraylength(samples); i += 1) {
            samples[i]->accumulatedMaterialResponse += samples[i]->materialResponse;
            samples[i]->accumulatedMaterialPdf += samples[i]->materialPdf;
        }
    }
};

// Callers rely on each header to bring these.
#ifndef STDRSL_SHADINGCONTEXT_H
#include <stdrsl/fresnel.h>
#endif

#endif
