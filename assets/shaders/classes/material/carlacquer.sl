/* carlacquer.sl: flakes in a colour that turns with the view, below a clear coat.
   evaluateSamples() gives the response of both layers to a direction, directlighting() the light
   of all lights by it, and indirectspecular() what the coat mirrors.
   Parameters: face, edge, flakes, flakescale, coat. */
#include <stdrsl/ShadingContext.h>
#include <stdrsl/Fresnel.h>
#include <stdrsl/SpecularBlinn.h>

class carlacquer(color face = color(0.45, 0.02, 0.04); color edge = color(0.12, 0.02, 0.22);
                 color flakes = color(1, 0.75, 0.55); float flakescale = 90; float coat = 0.03;
                 output varying color coatlight = 0;) {
    stdrsl_ShadingContext context;
    stdrsl_Fresnel boundary;
    stdrsl_SpecularBlinn clear;
    varying color base = 0;
    varying vector tilt = 0;
    varying float sparkle = 0;

    public void construct() { context->construct(); }
    public void begin() {
        context->init();
        boundary->initSchlick(context, 1, 1.5, 0.04);
    }
    public void prelighting(output color Ci, Oi) {
        point Q = flakescale * transform("object", P);
        tilt = vector cellnoise(Q) - vector(0.5, 0.5, 0.5);
        sparkle = smoothstep(0.72, 0.95, float cellnoise(Q + vector(7, 7, 7)));
        float facing = abs(context->m_Nn . context->m_Vn);
        base = mix(edge, face, pow(facing, 1.4));
        clear->init(context, color(boundary->m_Kr), coat, 1, 1);
    }
    public void evaluateSamples(string what; output __radiancesample samples[]) {
        float i;
        if (what == "specular") {
            clear->evalSpecularSamps(context, boundary, samples);
            return;
        }
        for (i = 0; i < arraylength(samples); i += 1) {
            vector towards = samples[i]->direction;
            float cosine = max(0, towards . context->m_Ns);
            vector half = normalize(towards + context->m_Vn);
            float lobe = pow(max(0, half . normalize(vector(context->m_Ns) + 0.5 * tilt)), 40);
            color below = base * cosine + (base + 0.35 * sparkle * flakes) * 2.5 * lobe * cosine;
            samples[i]->setMaterialResponse(boundary->m_Kt * below / PI, 0);
        }
    }
    public void generateSamples(string what; output __radiancesample samples[]) {
        clear->genSpecularSamps(context, boundary, what, samples);
    }
    public void lighting(output color Ci, Oi) {
        color matte = 0, shine = 0;
        directlighting(this, getlights(), "diffuseresult", matte, "specularresult", shine);
        coatlight = shine + indirectspecular(this);
        Ci = Oi * (matte + 0.4 * base * ambient() + coatlight);
    }
}
