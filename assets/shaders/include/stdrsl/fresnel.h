// stdrsl/Fresnel.h: what a smooth boundary reflects and lets through.
#ifndef STDRSL_FRESNEL_H
#define STDRSL_FRESNEL_H

#include <stdrsl/shadingcontext.h>

struct stdrsl_Fresnel {
    varying float m_Kr = 0;
    varying float m_Kt = 1;
    varying vector m_Rv = 0;  // reflected
    varying vector m_Tv = 0;  // refracted
    varying float m_eta = 1;

    void setEta(stdrsl_ShadingContext ctx; float mediaIor; float ior) {
        m_eta = ctx->m_EnteringRegion != 0 ? mediaIor / ior : ior / mediaIor;
    }
    void init(stdrsl_ShadingContext ctx; float mediaIor; float ior) {
        setEta(ctx, mediaIor, ior);
        normal facing = faceforward(ctx->m_Nn, ctx->m_In, ctx->m_Nn);
        fresnel(ctx->m_In, facing, m_eta, m_Kr, m_Kt, m_Rv, m_Tv);
        m_Kt = 1 - m_Kr;
    }
    // Schlick 1994, with the reflectance at normal incidence; ior 0: nothing is refracted.
    void initSchlick(stdrsl_ShadingContext ctx; float mediaIor; float ior; float reflectance) {
        normal facing = faceforward(ctx->m_Nn, ctx->m_In, ctx->m_Nn);
        float grazing = 1 - abs(ctx->m_In . facing);
        m_Kr = mix(reflectance, 1, pow(grazing, 5));
        m_Kt = 1 - m_Kr;
        m_Rv = reflect(ctx->m_In, facing);
        m_Tv = 0;
        if (ior > 0) {
            setEta(ctx, mediaIor, ior);
            m_Tv = refract(ctx->m_In, facing, m_eta);
        }
    }
};

#endif
