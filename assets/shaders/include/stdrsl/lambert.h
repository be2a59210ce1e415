// stdrsl/Lambert.h: a matte lobe for sample-based lighting.
#ifndef STDRSL_LAMBERT_H
#define STDRSL_LAMBERT_H

#include <stdrsl/fresnel.h>
#include <stdrsl/radiancesample.h>

struct stdrsl_Lambert {
    varying color m_diffColor = 0.5;
    uniform float m_minSamples = 1;
    uniform float m_maxSamples = 1;
    varying float m_sampleCount = 0;

    void init(color diffuseColor) { m_diffColor = diffuseColor; }
    void init(stdrsl_ShadingContext ctx; color diffuseColor; uniform float minimum;
              uniform float maximum) {
        m_diffColor = diffuseColor;
        m_minSamples = minimum;
        m_maxSamples = maximum;
        ctx->m_SampleMgr->computeDepthBasedSampleReduction(ctx->m_DiffuseDepth, maximum, minimum, 1,
                                                           m_sampleCount);
    }
    // Response and pdf of directions that lights chose.
    void evalDiffuseSamps(stdrsl_ShadingContext ctx; stdrsl_Fresnel fres;
                          output __radiancesample samples[]) {
        float i;
        for (i = 0; i < arraylength(samples); i += 1) {
            float cosine = max(0, samples[i]->direction . ctx->m_Ns);
            samples[i]->setMaterialResponse(m_diffColor * fres->m_Kt * cosine * M_INVPI, 0);
        }
    }
    // Directions by the cosine, appended.
    void genDiffuseSamps(stdrsl_ShadingContext ctx; stdrsl_Fresnel fres;
                         output __radiancesample samples[]) {
        float i;
        for (i = 0; i < m_sampleCount; i += 1) {
            float radius = sqrt(random()), angle = M_TWOPI * random();
            float cosine = sqrt(max(0, 1 - radius * radius));
            vector towards = ctx->m_Tangent * (radius * cos(angle)) +
                             ctx->m_Bitangent * (radius * sin(angle)) + ctx->m_Ns * cosine;
            __radiancesample made;
            made->setMaterialSample(m_diffColor * fres->m_Kt * cosine * M_INVPI, cosine * M_INVPI,
                                    normalize(towards), M_MAXDIST);
            push(samples, made);
        }
    }
};

#endif
