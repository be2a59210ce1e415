// stdrsl/SpecularBlinn.h: Blinn's microfacet lobe (1977) with Torrance and Sparrow's masking.
#ifndef STDRSL_SPECULARBLINN_H
#define STDRSL_SPECULARBLINN_H

#include <stdrsl/fresnel.h>
#include <stdrsl/radiancesample.h>

struct stdrsl_SpecularBlinn {
    varying color m_specColor = 1;  // with the reflectance
    varying float m_roughness = 0.1;  // the exponent is 1 / roughness^2
    varying float m_sampleCount = 1;

    void init(stdrsl_ShadingContext ctx; color specColor; float roughness; uniform float minimum;
              uniform float maximum) {
        m_specColor = specColor;
        m_roughness = max(0.001, roughness);
        ctx->m_SampleMgr->computeDepthBasedSampleReduction(ctx->m_RayDepth, maximum, minimum, 1,
                                                           m_sampleCount);
    }
    void init(stdrsl_ShadingContext ctx; string distribution; color specColor; float roughness;
              uniform float minimum; uniform float maximum) {
        init(ctx, specColor, roughness, minimum, maximum);
    }
    // Response (bsdf x cosine x color) and pdf of a direction by solid angle.
    void evaluate(stdrsl_ShadingContext ctx; vector towards; output color response;
                  output float pdf) {
        float n = 1 / (m_roughness * m_roughness);
        vector half = normalize(towards + ctx->m_Vn);
        float cosine_l = towards . ctx->m_Ns, cosine_v = ctx->m_Vn . ctx->m_Ns;
        float cosine_h = half . ctx->m_Ns, between = half . ctx->m_Vn;
        response = 0;
        pdf = 0;
        if (cosine_l > 0 && cosine_v > 0 && between > 0) {
            float lobe = pow(min(1, cosine_h), n) * M_INVTWOPI;
            float masked = min(1, 2 * cosine_h * min(cosine_v, cosine_l) / between);
            response = m_specColor * (n + 2) * lobe * masked / (4 * cosine_v);
            pdf = (n + 1) * lobe / (4 * between);
        }
    }
    void evalSpecularSamps(stdrsl_ShadingContext ctx; stdrsl_Fresnel fres;
                           output __radiancesample samples[]) {
        float i, pdf = 0;
        color response = 0;
        for (i = 0; i < arraylength(samples); i += 1) {
            evaluate(ctx, samples[i]->direction, response, pdf);
            samples[i]->setMaterialResponse(response, pdf);
        }
    }
    // Directions by the lobe, appended: those below the surface, whose pdf is 0, count as well.
    void genSpecularSamps(stdrsl_ShadingContext ctx; stdrsl_Fresnel fres; string what;
                          output __radiancesample samples[]) {
        float n = 1 / (m_roughness * m_roughness), i, pdf = 0;
        color response = 0;
        for (i = 0; i < m_sampleCount; i += 1) {
            float angle = M_TWOPI * random(), cosine = pow(1 - random(), 1 / (n + 1));
            float sine = sqrt(max(0, 1 - cosine * cosine));
            vector half = ctx->m_Tangent * (sine * cos(angle)) +
                          ctx->m_Bitangent * (sine * sin(angle)) + ctx->m_Ns * cosine;
            vector towards = normalize(reflect(-ctx->m_Vn, half));
            evaluate(ctx, towards, response, pdf);
            __radiancesample made;
            made->setMaterialSample(response, pdf, towards, M_MAXDIST);
            push(samples, made);
        }
    }
};

#endif
