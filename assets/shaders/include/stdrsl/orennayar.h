// stdrsl/OrenNayar.h: a rough matte lobe (Oren and Nayar 1994, qualitative model).
#ifndef STDRSL_ORENNAYAR_H
#define STDRSL_ORENNAYAR_H

#include <stdrsl/fresnel.h>
#include <stdrsl/radiancesample.h>

struct stdrsl_OrenNayar {
    varying color m_diffColor = 0.5;
    varying float m_roughness = 0.5;  // standard deviation of the slopes' angle

    void init(color diffuseColor; float roughness) {
        m_diffColor = diffuseColor;
        m_roughness = roughness;
    }
    void init(stdrsl_ShadingContext ctx; color diffuseColor; float roughness;) {
        init(diffuseColor, roughness);
    }
    void init(stdrsl_ShadingContext ctx; color diffuseColor; float roughness;
              uniform float minimum; uniform float maximum) {
        init(diffuseColor, roughness);
    }
    void evalDiffuseSamps(stdrsl_ShadingContext ctx; stdrsl_Fresnel fres;
                          output __radiancesample samples[]) {
        float square = m_roughness * m_roughness;
        float A = 1 - 0.5 * square / (square + 0.33), B = 0.45 * square / (square + 0.09);
        float cosine_v = ctx->m_Vn . ctx->m_Ns, i;
        vector across_v = ctx->m_Vn - ctx->m_Ns * cosine_v;
        for (i = 0; i < arraylength(samples); i += 1) {
            float cosine = samples[i]->direction . ctx->m_Ns;
            vector across = samples[i]->direction - ctx->m_Ns * cosine;
            float turned = max(0, across . across_v) /
                           max(1e-6, max(cosine, cosine_v));
            samples[i]->setMaterialResponse(
                m_diffColor * fres->m_Kt * max(0, cosine) * M_INVPI * (A + B * turned), 0);
        }
    }
};

#endif
