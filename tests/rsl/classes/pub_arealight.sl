#include <stdrsl/AreaSampler.h>
#include <stdrsl/SampleMgr.h>
#include <stdrsl/RadianceSample.h>
// RPS-style area light
class arealight(
    uniform float intensity = 1, exposure = 0;
    uniform color lightcolor = color(1,1,1);
    uniform string shape = "rect";
    uniform float sides = 1;
    uniform string lightcolormap = "";
    uniform float coneangle = 90, penumbraangle = 5, penumbraexponent = 0;
    uniform string shadowname = "";
    uniform float samples = 16, minsamples = 1;
    uniform float reverse = 0;
    uniform float falloff = 2, falloffDist = 0;
    uniform string __group = "";
    uniform string __category = "stdrsl,arealight";
    output float __nondiffuse = 0, __nonspecular = 0;
)
{
    stdrsl_AreaSampler m_sampler;
    stdrsl_SampleMgr m_sampleMgr;
    constant float m_cosOuter = cos(radians(coneangle));
    constant float m_cosInner = cos(radians(max(0, coneangle - penumbraangle)));
    uniform color m_emission = 0;
    uniform float m_nsamps = 0;
    varying filterregion m_fr;

    public void construct() {
        m_emission = lightcolor * intensity * pow(2, exposure);
    }
    public void begin() {
        uniform float depth = 0;
        rayinfo("depth", depth);
        m_sampleMgr->computeDepthBasedSampleReduction(depth, samples, minsamples, 0, m_nsamps);
        m_fr->calculate3d(Ps);
    }
    private color emission(float ss, tt; vector dir;) {
        varying color c = m_emission;
        if (lightcolormap != "") {
            c *= color texture(lightcolormap, ss, 1-tt);
        }
        if (coneangle < 90) {
            normal shaderN = normalize(ntransform("shader", "current", normal(0, 0, 1)));
            float cosangle = -(dir . shaderN);
            c *= smoothstep(m_cosOuter, m_cosInner, cosangle);
        }
        return c;
    }
    public void light(output vector L; output color Cl) {
        point from = point "shader" (0, 0, 0);
        L = Ps - from;
        Cl = 0;
    }
    public void generateSamples(string type; output __radiancesample samples[]) {
        uniform float i;
        if (type == "sphere" || type == "hemisphere") {
            m_sampler->generateSamples(Ps, shape, m_nsamps, samples);
            uniform float n = arraylength(samples);
            for (i = 0; i < n; i += 1) {
                float pdf = samples[i]->lightPdf;
                if (pdf < 0 && sides == 2) pdf = -pdf;
                if (pdf > 0)
                    samples[i]->radiance = emission(comp(samples[i]->radiance, 0), samples[i]->radiance[1], samples[i]->direction);
                else samples[i]->radiance = 0;
                samples[i]->lightPdf = abs(pdf);
                if (type == "hemisphere" && (samples[i]->direction . Ns) < 0) samples[i]->radiance = 0;
            }
        }
    }
    public void evaluateSamples(string type; output __radiancesample samples[]) {
        m_sampler->evaluateSamples(Ps, shape, samples);
        uniform float i, n = arraylength(samples);
        for (i = 0; i < n; i += 1) {
            if (samples[i]->lightPdf > 0)
                samples[i]->setRadiance(emission(samples[i]->radiance[0], samples[i]->radiance[1], samples[i]->direction));
        }
    }
    public void shadowSamples(output __radiancesample samples[]) {
        areashadow(shadowname, m_fr, samples, "raytrace", shadowname == "" ? 1 : 0);
    }
    public void generatePhoton(output point origin; output vector direction; output color power; output float pdf) {
        varying float ss=0, tt=0, area=0;
        m_sampler->generatePhoton(shape, sides, origin, direction, ss, tt, area);
        power = emission(ss, tt, direction) * area * PI;
        pdf = 1/area;
    }
}
