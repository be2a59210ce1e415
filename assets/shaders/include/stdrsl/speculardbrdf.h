// stdrsl/SpecularDBRDF.h: the lobe of Ashikhmin and Premoze's distribution-based BRDF (2007), with
// Beckmann's or Blinn's distribution of normals.
#ifndef STDRSL_SPECULARDBRDF_H
#define STDRSL_SPECULARDBRDF_H

#include <stdrsl/fresnel.h>
#include <stdrsl/radiancesample.h>

struct stdrsl_SpecularDBRDF {
    varying color m_specColor = 1;    // with the reflectance
    varying float m_roughness = 0.1;  // Beckmann's m; Blinn's exponent is 1 / m^2
    varying float m_sampleCount = 1;
    uniform float m_beckmann = 1;     // 0: Blinn's

    void init(stdrsl_ShadingContext ctx; uniform string distribution; color specColor;
              float roughness; uniform float minimum; uniform float maximum) {
        m_beckmann = distribution == "blinn" ? 0 : 1;
        m_specColor = specColor;
        m_roughness = max(0.001, roughness);
        ctx->m_SampleMgr->computeDepthBasedSampleReduction(ctx->m_RayDepth, maximum, minimum, 1,
                                                           m_sampleCount);
    }
    // The distribution p(h), whose integral over the hemisphere of h is 1.
    float distributionOf(float cosine) {
        float square = m_roughness * m_roughness;
        if (m_beckmann == 0) return (1 / square + 1) * M_INVTWOPI * pow(cosine, 1 / square);
        float c2 = max(1e-6, cosine * cosine);
        return exp((c2 - 1) / (c2 * square)) / (M_PI * square * c2 * max(1e-3, cosine));
    }
    // Response (bsdf x cosine x color) and pdf of a direction by solid angle.
    void evaluate(stdrsl_ShadingContext ctx; vector towards; output color response;
                  output float pdf) {
        vector half = normalize(towards + ctx->m_Vn);
        float cosine_l = towards . ctx->m_Ns, cosine_v = ctx->m_Vn . ctx->m_Ns;
        float cosine_h = half . ctx->m_Ns, between = half . ctx->m_Vn;
        response = 0;
        pdf = 0;
        if (cosine_l > 0 && cosine_v > 0 && between > 0) {
            float p = distributionOf(cosine_h);
            response = m_specColor * p * cosine_l /
                       (4 * (cosine_l + cosine_v - cosine_l * cosine_v));
            pdf = p / (4 * between);
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
        float square = m_roughness * m_roughness, i, pdf = 0;
        color response = 0;
        for (i = 0; i < m_sampleCount; i += 1) {
            float angle = M_TWOPI * random(), x = 1 - random();
            float cosine = m_beckmann != 0 ? 1 / sqrt(1 - square * log(x))
                                           : pow(x, 1 / (1 / square + 1));
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
