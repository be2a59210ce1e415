/* A physically plausible dielectric, RPS 16 manner. */
#include <stdrsl/ShadingContext.h>
#include <stdrsl/RadianceSample.h>
#include <stdrsl/Lambert.h>
#include <stdrsl/SpecularAS.h>
#include <stdrsl/Fresnel.h>
#include <stdrsl/SampleMgr.h>
#include <stdrsl/Colors.h>
#include <stdrsl/Math.h>

#define EPSILON 0.0005

class plausible_dielectric(
    uniform string surfaceMap = "";
    uniform color surfaceColor = color(0.5,0.5,0.5);
    uniform float applySRGB = 1;
    uniform float diffuseGain = 0.8;
    uniform float specularGain = 0.5;
    uniform string specularMap = "";
    uniform color specularColor = color 1;
    uniform float roughness = 0.1, anisotropy = 0;
    uniform string roughnessMap = "";
    uniform float ior = 1.5;
    uniform float mediaIor = 1;
    uniform string bumpMap = "", displacementMap = "";
    uniform float displacementAmount = 0;
    uniform float indirectSpecular = 1, indirectDiffuse = 1;
    uniform float samples = 16, minsamples = 4;
    uniform float maxSpecularDistance = 1e10;
    uniform string lightCategory = "";
    uniform string __category = "plausible";
    output varying color __diffuse = 0;
    output varying color __specular = color(0);
    output varying color __indirectdiffuse = 0;
    output varying color __unshadowed;
    )
{
    stdrsl_ShadingContext m_shadingCtx;
    stdrsl_Fresnel m_fres;
    stdrsl_Lambert m_diffuse;
    stdrsl_SpecularAS m_specular;
    stdrsl_ShadingUtils m_utils;
    varying color m_diffuseColor, m_specularColor;
    uniform float m_diffuseSamples = 0;
    uniform shader m_lights[];
    uniform string m_groups[];
    uniform float m_nGroups = 0;

    public void construct() {
        m_shadingCtx->construct();
        m_nGroups = 0;
        option("user:lightgroups", m_groups);
        m_nGroups = arraylength(m_groups);
    }
    public void begin() {
        m_shadingCtx->init();
        m_diffuseColor = 0;
        m_specularColor = 0;
        if (lightCategory != "") m_lights = getlights("category", lightCategory);
        else m_lights = getlights();
    }
    public void displacement(output point P; output normal N) {
        if(displacementAmount != 0 && displacementMap != "") {
            float disp = texture(displacementMap[0], s, t);
            m_shadingCtx->displace(m_shadingCtx->m_Nn, disp*displacementAmount, "displace");
        }
        if(bumpMap != "") {
            float disp = texture(bumpMap[0], s, t);
            m_shadingCtx->displace(m_shadingCtx->m_Nn, disp, "bump");
        }
    }
    public void opacity(output color Oi) { Oi = Os; }
    public void initDiff() {
        color c = surfaceColor;
        if (surfaceMap != "") {
            color t0 = color texture(surfaceMap, s, t);
            if (applySRGB != 0) t0 = srgbToLinear(t0);
            c *= t0;
        }
        m_diffuseColor = diffuseGain * c * Cs;
        m_diffuse->init(m_shadingCtx, m_diffuseColor, minsamples, samples);
    }
    public void initSpec() {
        m_fres->init(m_shadingCtx, mediaIor, ior);
        color c = specularGain * specularColor * m_fres->m_Kr;
        if(specularMap != "") c *= color texture(specularMap);
        m_specularColor = c;
        m_specular->init(m_shadingCtx, c, roughness, anisotropy, 1.0, minsamples, samples);
    }
    public void prelighting(output color Ci, Oi) {
        initDiff();
        initSpec();
    }
    public void lighting(output color Ci, Oi) {
        __radiancesample samps[];
        color udiff = 0, uspec = 0;
        color gdiff[], gspec[];
        if (m_nGroups > 0) { resize(gdiff, m_nGroups); resize(gspec, m_nGroups); }
        directlighting(this, m_lights,
                "mis", 1, "heuristic", "veachpower2",
                "materialsamples", samps,
                "diffuseresult", __diffuse, "specularresult", __specular,
                "unshadoweddiffuseresult", udiff, "unshadowedspecularresult", uspec);
        __unshadowed = udiff + uspec;
        Ci += __diffuse + __specular;
        if (indirectSpecular != 0)
            Ci += indirectspecular(this, "materialsamples", samps, "maxdist", maxSpecularDistance, "samplebase", 0.1);
        if (indirectDiffuse != 0) {
            uniform float nsamps = samples;
            if (m_shadingCtx->m_RayDepth > 0) nsamps = minsamples;
            __indirectdiffuse = m_diffuseColor * indirectdiffuse(P, m_shadingCtx->m_Ns, nsamps, "adaptive", 1, "maxvariation", 0.02);
            Ci += __indirectdiffuse;
        }
        Ci *= Oi;
    }
    public void evaluateSamples(string distribution; output __radiancesample samples[]) {
        if (distribution == "diffuse")
            m_diffuse->evalDiffuseSamps(m_shadingCtx, m_fres, samples);
        else if (distribution == "specular")
            m_specular->evalSpecularSamps(m_shadingCtx, m_fres, samples);
    }
    public void generateSamples(string distribution; output __radiancesample samples[]) {
        if (distribution != "diffuse")
            m_specular->genSpecularSamps(m_shadingCtx, m_fres, distribution, samples);
    }
}
