#include <stdrsl/AreaSampler.h>
class photon_light(uniform float intensity = 1; uniform color lightcolor = 1; uniform string shape = "sphere"; uniform float emitsamples = 8; uniform float traceShadows = 1; string __category = "key,physical";)
{
    stdrsl_AreaSampler m_area;
    public void generatePhoton(output point origin; output vector direction; output color power; output float pdf)
    {
        varying float ss, tt, area;
        m_area->generatePhoton(shape, 1, origin, direction, ss, tt, area);
        power = intensity * lightcolor * area * PI;
        pdf = 1;
    }
    public void generateSamples(string distribution; output __radiancesample s[])
    {
        m_area->generateSamples(Ps, shape, emitsamples, s);
        uniform float i;
        for (i = 0; i < arraylength(s); i += 1) s[i]->setRadiance(intensity * lightcolor);
    }
    public void evaluateSamples(string distribution; output __radiancesample s[])
    {
        m_area->evaluateSamples(Ps, shape, s);
    }
    public void shadowSamples(output __radiancesample s[])
    {
        uniform float i, n = arraylength(s);
        if (traceShadows == 1) {
            for (i = 0; i < n; i += 1) {
                s[i]->radiance *= transmission(Ps, Ps + s[i]->direction * s[i]->distance);
            }
        }
    }
    public void light(output vector L; output color Cl)
    {
        L = vector "shader" (0, 0, 1);
        Cl = 0;
        illuminate(point "shader" (0, 0, 0)) Cl = intensity * lightcolor / (L . L);
    }
}
