// stdrsl/IsotropicVolume.h: a volume that scatters light equally to all sides.
#ifndef STDRSL_ISOTROPICVOLUME_H
#define STDRSL_ISOTROPICVOLUME_H

#include <stdrsl/fresnel.h>
#include <stdrsl/radiancesample.h>

struct stdrsl_IsotropicVolume {
    varying color m_diffColor = 1;  // the albedo

    void init(color albedo) { m_diffColor = albedo; }
    // The phase function is 1 / (4 PI) in every direction.
    void evalDiffuseSamps(stdrsl_ShadingContext ctx; stdrsl_Fresnel fres;
                          output __radiancesample samples[]) {
        float i;
        for (i = 0; i < arraylength(samples); i += 1)
            samples[i]->setMaterialResponse(m_diffColor * M_INVFOURPI, 0);
    }
};

#endif
