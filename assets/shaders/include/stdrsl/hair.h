// stdrsl/Hair.h: light on fibres: Kajiya and Kay's diffuse (1989), and the reflection R of Marschner
// and others (2003). The context is that of initHair(): its tangent lies along the hair.
#ifndef STDRSL_HAIR_H
#define STDRSL_HAIR_H

#include <stdrsl/fresnel.h>
#include <stdrsl/radiancesample.h>

struct stdrsl_Hair {
    varying color m_rootColor = 0.5;
    varying color m_tipColor = 0.5;
    varying float m_gain = 1;
    varying color m_reflect = 1;    // towards the side that the light is on
    varying color m_transmit = 0.5; // to the other
    varying float m_sampleCount = 1;
    varying color m_specTransmit = 0;
    varying color m_specReflect = 1;
    varying float m_shift = 0;      // of the scales, in radians towards the root
    varying float m_width = 0.2;    // of the lobe along the hair, in radians
    varying float m_index = 1.55;

    void initDiffuse(stdrsl_ShadingContext ctx; float gain; color reflectance; color transmittance;
                     color root; color tip) {
        m_gain = gain;
        m_reflect = reflectance;
        m_transmit = transmittance;
        m_rootColor = root;
        m_tipColor = tip;
    }
    void initSpecular(stdrsl_ShadingContext ctx; float count; color transmittance; float shift;
                      float width; color reflectance; float index) {
        m_sampleCount = count;
        m_specTransmit = transmittance;
        m_specReflect = reflectance;
        m_shift = shift;
        m_width = max(0.01, width);
        m_index = index;
    }
    // 1 where light and viewer are on one side of the hair, 0 where it lies between them.
    float frontOf(stdrsl_ShadingContext ctx; vector towards) {
        vector l = towards - ctx->m_Tangent * (towards . ctx->m_Tangent);
        vector v = ctx->m_Vn - ctx->m_Tangent * (ctx->m_Vn . ctx->m_Tangent);
        float both = length(l) * length(v);
        return both > 1e-6 ? 0.5 + 0.5 * (l . v) / both : 1;
    }
    color diffuseResponse(stdrsl_ShadingContext ctx; vector towards) {
        extern float v;
        float along = towards . ctx->m_Tangent, sine = sqrt(max(0, 1 - along * along));
        return mix(m_rootColor, m_tipColor, v) * m_gain * sine * M_INVPI *
               mix(m_transmit, m_reflect, frontOf(ctx, towards));
    }
    color specularResponse(stdrsl_ShadingContext ctx; vector towards) {
        float theta_l = asin(clamp(towards . ctx->m_Tangent, -1, 1));
        float theta_v = asin(clamp(ctx->m_Vn . ctx->m_Tangent, -1, 1));
        float off = (theta_l + theta_v) / 2 - m_shift;
        float lobe = exp(-off * off / (2 * m_width * m_width)) / (m_width * sqrt(M_TWOPI));
        float front = frontOf(ctx, towards);
        float r0 = pow((m_index - 1) / (m_index + 1), 2);
        float between = (theta_l - theta_v) / 2, kr = r0 + (1 - r0) * pow(1 - cos(between), 5);
        // The cross-section spreads light as the cosine of half the angle around the hair.
        return lobe * kr * mix(m_specTransmit, m_specReflect, front) * sqrt(front) * 0.25 /
               max(0.01, cos(between));
    }
    void evalDiffuseSamps(stdrsl_ShadingContext ctx; output __radiancesample samples[]) {
        float i;
        for (i = 0; i < arraylength(samples); i += 1)
            samples[i]->setMaterialResponse(diffuseResponse(ctx, samples[i]->direction), 0);
    }
    void evalSpecularSamps(stdrsl_ShadingContext ctx; output __radiancesample samples[]) {
        float i;
        for (i = 0; i < arraylength(samples); i += 1)
            samples[i]->setMaterialResponse(specularResponse(ctx, samples[i]->direction),
                                            M_INVFOURPI);
    }
    // Over the whole sphere.
    vector anyDirection() {
        float z = 1 - 2 * random(), angle = M_TWOPI * random(), r = sqrt(max(0, 1 - z * z));
        return vector "current" (r * cos(angle), r * sin(angle), z);
    }
    void genDiffuseSamps(stdrsl_ShadingContext ctx; output __radiancesample samples[]) {
        float i;
        for (i = 0; i < m_sampleCount; i += 1) {
            __radiancesample made;
            vector towards = anyDirection();
            made->setMaterialSample(diffuseResponse(ctx, towards), M_INVFOURPI, towards, M_MAXDIST);
            push(samples, made);
        }
    }
    void genSpecularSamps(stdrsl_ShadingContext ctx; output __radiancesample samples[]) {
        float i;
        for (i = 0; i < m_sampleCount; i += 1) {
            __radiancesample made;
            vector towards = anyDirection();
            made->setMaterialSample(specularResponse(ctx, towards), M_INVFOURPI, towards,
                                    M_MAXDIST);
            push(samples, made);
        }
    }
};

#endif
