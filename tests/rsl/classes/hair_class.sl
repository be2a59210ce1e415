#include <stdrsl/ShadingContext.h>
#include <stdrsl/RadianceSample.h>
#include <stdrsl/Hair.h>
class hair_class(color rootColor = color(0.2, 0.1, 0.05); color tipColor = color(0.6, 0.4, 0.2); float gain = 1, width = 0.15, shift = -0.1; uniform float nsamples = 4;)
{
    stdrsl_ShadingContext m_shadingCtx;
    stdrsl_Hair m_hair;
    public void begin()
    {
        m_shadingCtx->initHair(0);
        m_hair->initDiffuse(m_shadingCtx, gain, 1, 0.5, rootColor, tipColor);
        m_hair->initSpecular(m_shadingCtx, nsamples, 0.2, shift, width, 0.6, 1.55);
    }
    public void evaluateSamples(string distribution; output __radiancesample samples[])
    {
        if (distribution == "diffuse") m_hair->evalDiffuseSamps(m_shadingCtx, samples);
        else m_hair->evalSpecularSamps(m_shadingCtx, samples);
    }
    public void generateSamples(string distribution; output __radiancesample samples[])
    {
        if (distribution == "specular") m_hair->genSpecularSamps(m_shadingCtx, samples);
    }
    public void lighting(output color Ci, Oi)
    {
        color d = 0, sp = 0;
        Ci = Os * directlighting(this, getlights(), "diffuseresult", d, "specularresult", sp, "integrationdomain", "sphere");
        Oi = Os;
    }
}
