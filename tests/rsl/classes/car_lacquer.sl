// Base coat with flakes below a clear coat, by samples.
#include <stdrsl/ShadingContext.h>
#include <stdrsl/RadianceSample.h>
#include <stdrsl/Lambert.h>
#include <stdrsl/SpecularAS.h>

class car_lacquer(
    uniform float baseRoughness = 0.3;
    uniform float coatRoughness = 0.02;
    uniform color baseColor = color(0.3, 0.02, 0.04);
    uniform color flakeColor = color(0.9, 0.7, 0.5);
    uniform float flakeScale = 40;
    uniform float ior = 1.5, mediaIor = 1;
    uniform float minSamples = 4, maxSamples = 16;
    output varying color aov_diffuse = 0;
    output varying color aov_specular = 0;
    )
{
    stdrsl_ShadingContext m_shadingCtx;
    stdrsl_Fresnel m_fres;
    stdrsl_Lambert m_lambert;
    stdrsl_SpecularAS m_base;
    stdrsl_SpecularAS m_coat;

    public void construct() {
        m_shadingCtx->construct();
    }
    public void begin() {
        m_shadingCtx->init();
        m_fres->init(m_shadingCtx, mediaIor, ior);
    }
    public void prelighting(output color Ci, Oi) {
        float flake = cellnoise(s * flakeScale, t * flakeScale);
        flake = flake > 0.8 ? 1 : 0;
        m_lambert->init(m_shadingCtx, baseColor * (1 - m_fres->m_Kr), minSamples, maxSamples);
        m_base->init(m_shadingCtx, mix(baseColor, flakeColor, flake) * 0.4, baseRoughness, 0, 1,
                     minSamples, maxSamples);
        m_coat->init(m_shadingCtx, color m_fres->m_Kr, coatRoughness, 0, 1, minSamples, maxSamples);
        Oi = color(1);
    }
    public void lighting(output color Ci, Oi) {
        __radiancesample samples[];
        color diffuseResult = 0, specularResult = 0;
        directlighting(this, getlights(), "mis", 1, "heuristic", "veachpower2",
                       "materialsamples", samples,
                       "diffuseresult", diffuseResult, "specularresult", specularResult);
        specularResult += indirectspecular(this, "materialsamples", samples);
        aov_diffuse = diffuseResult;
        aov_specular = specularResult;
        Ci += Oi * (diffuseResult + specularResult);
    }
    public void evaluateSamples(string distribution; output __radiancesample samples[]) {
        if (distribution == "diffuse") {
            m_lambert->evalDiffuseSamps(m_shadingCtx, m_fres, samples);
        } else {
            varying color first[];
            varying float pdfs[];
            uniform float i, n = arraylength(samples);
            m_base->evalSpecularSamps(m_shadingCtx, m_fres, samples);
            for (i = 0; i < n; i += 1) {
                push(first, samples[i]->materialResponse);
                push(pdfs, samples[i]->materialPdf);
            }
            m_coat->evalSpecularSamps(m_shadingCtx, m_fres, samples);
            for (i = 0; i < n; i += 1) {
                samples[i]->setMaterialResponse(samples[i]->materialResponse + first[i],
                                                0.5 * (samples[i]->materialPdf + pdfs[i]));
            }
        }
    }
    public void generateSamples(string distribution; output __radiancesample samples[]) {
        if (distribution == "specular" || distribution == "indirectspecular") {
            m_base->genSpecularSamps(m_shadingCtx, m_fres, distribution, samples);
            m_coat->genSpecularSamps(m_shadingCtx, m_fres, distribution, samples);
        }
    }
}
