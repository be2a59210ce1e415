// stdrsl/SpecularAS.h: the anisotropic lobe of Ashikhmin and Shirley (2000).
#ifndef STDRSL_SPECULARAS_H
#define STDRSL_SPECULARAS_H

#include <stdrsl/fresnel.h>
#include <stdrsl/radiancesample.h>

struct stdrsl_SpecularAS {
    varying color m_specColor = 1;  // with the reflectance
    varying float m_roughValueU = 0.1;  // exponents are 1 / roughness^2
    varying float m_roughValueV = 0.1;
    varying float m_sampleCount = 1;

    // anisotropy -1 to 1: above 0 the lobe is long along the tangent.
    void init(stdrsl_ShadingContext ctx; color specColor; float roughness; float anisotropy;
              float roughnessScale; uniform float minimum; uniform float maximum) {
        m_specColor = specColor;
        m_roughValueU = max(0.001, roughness * roughnessScale * (1 + anisotropy));
        m_roughValueV = max(0.001, roughness * roughnessScale * (1 - anisotropy));
        ctx->m_SampleMgr->computeDepthBasedSampleReduction(ctx->m_RayDepth, maximum, minimum, 1,
                                                           m_sampleCount);
    }
    // No smoother than the layer that the ray came through; what a layer below shall know.
    void initWithDownstreamRoughness(float above; stdrsl_ShadingContext ctx; color specColor;
                                     float roughness; float anisotropy; uniform float minimum;
                                     uniform float maximum; output float below) {
        init(ctx, specColor, max(above, roughness), anisotropy, 1, minimum, maximum);
        below = max(above, roughness);
    }

    // Response (bsdf x cosine x color) and pdf of a direction by solid angle.
    void evaluate(stdrsl_ShadingContext ctx; vector towards; output color response;
                  output float pdf) {
        float nu = 1 / (m_roughValueU * m_roughValueU), nv = 1 / (m_roughValueV * m_roughValueV);
        vector half = normalize(towards + ctx->m_Vn);
        float cosine_l = towards . ctx->m_Ns, cosine_v = ctx->m_Vn . ctx->m_Ns;
        float cosine_h = half . ctx->m_Ns, along = half . ctx->m_Tangent,
              across = half . ctx->m_Bitangent, between = half . ctx->m_Vn;
        response = 0;
        pdf = 0;
        if (cosine_l > 0 && cosine_v > 0 && between > 0) {
            float sine2 = max(1e-12, along * along + across * across);
            float power = (nu * along * along + nv * across * across) / sine2;
            float lobe = sqrt((nu + 1) * (nv + 1)) * pow(min(1, cosine_h), power);
            response = m_specColor * lobe * M_INVFOURPI * 0.5 * cosine_l /
                       (between * max(cosine_l, cosine_v));
            pdf = lobe * M_INVTWOPI / (4 * between);
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
        float nu = 1 / (m_roughValueU * m_roughValueU), nv = 1 / (m_roughValueV * m_roughValueV);
        float i, pdf = 0;
        color response = 0;
        for (i = 0; i < m_sampleCount; i += 1) {
            float x = random() * M_TWOPI;
            float angle = atan(sqrt(nu + 1) * sin(x), sqrt(nv + 1) * cos(x));
            float c = cos(angle), s = sin(angle);
            float cosine = pow(1 - random(), 1 / (nu * c * c + nv * s * s + 1));
            float sine = sqrt(max(0, 1 - cosine * cosine));
            vector half = ctx->m_Tangent * (sine * c) + ctx->m_Bitangent * (sine * s) +
                          ctx->m_Ns * cosine;
            vector towards = normalize(reflect(-ctx->m_Vn, half));
            evaluate(ctx, towards, response, pdf);
            __radiancesample made;
            made->setMaterialSample(response, pdf, towards, M_MAXDIST);
            push(samples, made);
        }
    }
};

#endif
