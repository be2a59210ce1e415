#include <stdrsl/AreaSampler.h>
#include <stdrsl/Colors.h>
class area_sampler_light(
    uniform float intensity = 1; uniform color lightcolor = color(1);
    uniform string shape = "rect"; uniform string map = ""; uniform float sides = 1; float samples = 16;)
{
    stdrsl_AreaSampler m_sampler;
    public void construct() {}
    color emission(float ss, tt;)
    {
        color c = intensity * lightcolor;
        if (map != "") c *= srgbToLinear(color texture(map, ss, tt));
        return c;
    }
    public void generateSamples(string distribution; output __radiancesample samps[])
    {
        m_sampler->generateSamples(Ps, shape, samples, samps);
        radiate(samps);
    }
    public void evaluateSamples(string distribution; output __radiancesample samps[])
    {
        m_sampler->evaluateSamples(Ps, shape, samps);
        radiate(samps);
    }
    void radiate(output __radiancesample samps[])
    {
        uniform float n = arraylength(samps), i;
        for (i = 0; i < n; i += 1) {
            if (samps[i]->lightPdf > 0 || sides == 2) {
                color c = samps[i]->radiance;
                samps[i]->setRadiance(emission(c[0], c[1]));
                samps[i]->lightPdf = abs(samps[i]->lightPdf);
            } else {
                samps[i]->setRadiance(0);
            }
        }
    }
    public void light(output vector L; output color Cl)
    {
        L = Ps - point "shader" (0, 0, 0);
        Cl = emission(0.5, 0.5) / max(L . L, 1e-3);
    }
}
