#include <stdrsl/ShadingContext.h>
#include <stdrsl/Fresnel.h>
class seed_material(color diffuseColor = color(0.6, 0.3, 0.2); float Kd = 0.8, Ks = 0.2, eta = 1.4; uniform float num_diffuse_samps = 8;)
{
    stdrsl_ShadingContext m_shadingCtx;
    stdrsl_Fresnel m_fres;
    color diff_col = 0, spec_col = 0;
    public void begin() {
        m_shadingCtx->init();
        m_fres->init(m_shadingCtx, 1, eta);
    }
    public void evaluateSamples(string distribution; output _radiancesample samples[]) {
        float i, num_samps = arraylength(samples);
        normal Nn = m_shadingCtx->m_Nn;
        if (distribution == "specular") {
            for (i = 0; i < num_samps; i+=1) {
                vector Ln = samples[i]->direction;
                vector H = normalize(Ln + m_shadingCtx->m_Vn);
                samples[i]->setMaterialResponse(color pow(max(0, H.Nn), 60), 1);
            }
        } else if (distribution == "diffuse") {
            for (i = 0; i < num_samps; i+=1) {
                float cosTheta = (samples[i]->direction).Nn;
                color matresp = 0;
                if (cosTheta > 0) {
                    matresp = cosTheta * diffuseColor / PI;
                }
                samples[i]->setMaterialResponse(matresp, 0);
            }
        }
    }
    public void lighting(output color Ci, Oi) {
        __radiositysample samples[];
        directlighting(this, getlights(), "mis", 1, "heuristic", "veachpower2",
            "materialsamples", samples, "diffuseresult", diff_col, "specularresult", spec_col);
        color indir_diff = indirectdiffuse(P, m_shadingCtx->m_Nn, num_diffuse_samps);
        Ci += (Kd * (indir_diff + diff_col) * (1 - m_fres->m_Kr)) + Ks * spec_col;
        Ci *= Oi;
    }
}
