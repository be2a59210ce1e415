// stdrsl/BSDFComponent.h: what a lobe is to a material, as a base of structs of one's own: a lobe that
// reflects nothing.
#ifndef STDRSL_BSDFCOMPONENT_H
#define STDRSL_BSDFCOMPONENT_H

#include <stdrsl/fresnel.h>
#include <stdrsl/radiancesample.h>

struct stdrsl_BSDFComponent {
    varying float m_sampleCount = 0;

    void evalDiffuseSamps(stdrsl_ShadingContext ctx; stdrsl_Fresnel fres;
                          output __radiancesample samples[]) {
        float i;
        for (i = 0; i < arraylength(samples); i += 1) samples[i]->setMaterialResponse(color 0, 0);
    }
    void evalSpecularSamps(stdrsl_ShadingContext ctx; stdrsl_Fresnel fres;
                           output __radiancesample samples[]) {
        evalDiffuseSamps(ctx, fres, samples);
    }
    void genDiffuseSamps(stdrsl_ShadingContext ctx; stdrsl_Fresnel fres;
                         output __radiancesample samples[]) {}
    void genSpecularSamps(stdrsl_ShadingContext ctx; stdrsl_Fresnel fres; string what;
                          output __radiancesample samples[]) {}
};

#endif
