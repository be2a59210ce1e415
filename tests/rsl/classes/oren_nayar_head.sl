#include "stdrsl/OrenNayar.h"
#include "stdrsl/SpecularBlinn.h"
class oren_nayar_head(color clay = color(0.6, 0.35, 0.25); float sigma = 0.5; float gloss = 0.3; uniform float minS = 1, maxS = 8;)
{
    stdrsl_ShadingContext m_shadingCtx; stdrsl_Fresnel m_fres; stdrsl_OrenNayar m_diff; stdrsl_SpecularBlinn m_spec;
    public void construct() { m_shadingCtx->construct(); }
    public void begin() { m_shadingCtx->init(); }
    public void prelighting(output color Ci, Oi) {
        m_fres->initSchlick(m_shadingCtx, 1, 0, 0.04);
        m_diff->init(clay, sigma);
        m_spec->init(m_shadingCtx, color(m_fres->m_Kr), gloss, minS, maxS);
    }
    public void evaluateSamples(string what; output __radiancesample s[]) {
        if (what == "diffuse") m_diff->evalDiffuseSamps(m_shadingCtx, m_fres, s);
        if (what == "specular") m_spec->evalSpecularSamps(m_shadingCtx, m_fres, s);
    }
    public void generateSamples(string what; output __radiancesample s[]) {
        if (what == "specular" || what == "indirectspecular") m_spec->genSpecularSamps(m_shadingCtx, m_fres, what, s);
    }
    public void lighting(output color Ci, Oi) {
        color diffuseresult, specularresult;
        __radiancesample lobe[];
        Oi = Os;
        Ci += directlighting(this, getlights("category", ""), "diffuseresult", diffuseresult, "specularresult", specularresult, "materialsamples", lobe);
        Ci += indirectspecular(this, "materialsamples", lobe, "maxdist", 100, "samplebase", 0.5);
        Ci *= Oi;
    }
}
