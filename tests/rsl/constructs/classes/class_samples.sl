// class: the methods of sample-based lighting, called by the class itself
#include "stdrsl/Lambert.h"
class class_samples(color diffuseColor = color(0.5, 0.25, 1); float roughness = 0.2;) {
    stdrsl_ShadingContext m_shadingCtx;
    stdrsl_Fresnel m_fres;
    stdrsl_Lambert m_lambert;

    public void begin() {
        m_shadingCtx->init();
        m_fres->init(m_shadingCtx, 1, 1.5);
        m_lambert->init(diffuseColor);
    }
    public void evaluateSamples(string distribution; output __radiancesample samples[]) {
        uniform float size = arraylength(samples), i;
        if (distribution == "diffuse") {
            m_lambert->evalDiffuseSamps(m_shadingCtx, m_fres, samples);
        } else if (distribution == "specular") {
            for (i = 0; i < size; i += 1) {
                vector H = normalize(samples[i]->direction + m_shadingCtx->m_Vn);
                float shine = pow(max(0, H . m_shadingCtx->m_Ns), 1 / roughness);
                samples[i]->setMaterialResponse(color shine, 0);
            }
        }
    }
    public void lighting(output color Ci, Oi) {
        __radiancesample samples[];
        resize(samples, 2);
        samples[0]->setLightSample(color(1, 0.5, 0.25), 1, vector m_shadingCtx->m_Nn, 2);
        samples[1]->setLightSample(color 0.5, 1, normalize(vector(s, t, 1)), 2);
        Ci = 0;
        string kind[2] = {"diffuse", "specular"};
        uniform float k, i;
        for (k = 0; k < 2; k += 1) {
            evaluateSamples(kind[k], samples);
            for (i = 0; i < arraylength(samples); i += 1)
                Ci += samples[i]->radiance * samples[i]->materialResponse;
        }
    }
}
