// The other listings of ../shared/seeds/004, completed: a material whose own samples and the lights'
// meet. The lobe is that of Walter and others 2007 (GGX).
#include <stdrsl/ShadingContext.h>
#include <stdrsl/Fresnel.h>
class seed_material(color diffuseColor = color(0.6, 0.3, 0.2); color refl = 1; float Kd = 0.8, eta = 1.7;
                    float alpha = 0.13; uniform float num_samps = 16; uniform float num_diffuse_samps = 16;)
{
    stdrsl_ShadingContext m_shadingCtx;
    stdrsl_Fresnel m_fres;
    varying color diff_col = 0, spec_col = 0;
    public void begin() {
        m_shadingCtx->init();
        m_fres->init(m_shadingCtx, 1, eta);
    }
    // Response (with the cosine) and pdf of the lobe in a direction.
    void brdf(vector Ln; output color matresp; output float matpdf) {
        normal Nn = m_shadingCtx->m_Ns;
        vector Vn = m_shadingCtx->m_Vn;
        vector H = normalize(Ln + Vn);
        matresp = 0;
        matpdf = 0;
        if (Ln.Nn > 0 && Vn.Nn > 0) {
            float a = alpha * alpha, c = H.Nn, b = 1 + (a - 1) * c * c;
            float D = a / (PI * b * b);
            float G = 4 * (Ln.Nn) * (Vn.Nn) / ((Ln.Nn + sqrt(a + (1 - a) * (Ln.Nn) * (Ln.Nn))) *
                                               (Vn.Nn + sqrt(a + (1 - a) * (Vn.Nn) * (Vn.Nn))));
            float F = fresnel(-Vn, H);
            matresp = refl * (F*G*D)/(4*(Vn.Nn)*(Ln.Nn)) * (Ln.Nn);
            matpdf = (D*(H.Nn))/(4*(H.Vn)); //see paper for details
        }
    }
    float fresnel(vector In; vector H) {
        float Kr = 0, Kt = 0;
        fresnel(In, normal H, 1 / eta, Kr, Kt);
        return Kr;
    }
    public void generateSamples(string distribution;
            output __radiancesample samples[]) {
        //distribution = "specular", "indirectspecular", etc.
        if(distribution == "specular" || distribution == "indirectspecular") {
            /* append to the samples array - if it already has any,
            they are from the lights */
            color matresp = 0;
            float matpdf = 0;
            float i, start_size = arraylength(samples), size = start_size + num_samps;
            resize(samples, size);
            for(i = start_size; i < size; i+=1) {
                float x = random(), turn = 2 * PI * random();
                float cosine = sqrt((1 - x) / (1 + (alpha * alpha - 1) * x));
                float sine = sqrt(max(0, 1 - cosine * cosine));
                vector H = m_shadingCtx->m_Tangent * (sine * cos(turn)) +
                           m_shadingCtx->m_Bitangent * (sine * sin(turn)) + m_shadingCtx->m_Ns * cosine;
                vector Ln = normalize(reflect(-m_shadingCtx->m_Vn, H));
                //do my whole BRDF calculation
                brdf(Ln, matresp, matpdf);
                //store this material response, pdf, light dir and distance
                samples[i]->setMaterialSamples(matresp, matpdf, Ln, 1e30);
            }
        }
    }
    public void evaluateSamples(string distribution;
        output _radiancesample samples[]) {
        float i, num_samps = arraylength(samples);
        normal Nn = m_shadingCtx->m_Ns;
        color matresp = 0;
        float matpdf = 0;
        if(distribution == "specular") {
            for(i = 0; i < num_samps; i+=1) {
                //direction provided by light generateSamples()
                vector Ln = samples[i]->direction;
                //evaluate BRDF as above
                brdf(Ln, matresp, matpdf);
                samples[i]->setMaterialResponse(matresp, matpdf);
            }
        } else if (distribution == "diffuse") {
            //implement lambert or oren-nayar diffuse here
            for(i = 0; i < num_samps; i+=1) {
                float cosTheta = (samples[i]->direction).Nn; //Lambert
                matresp = 0;
                if(cosTheta > 0) {
                    matresp = cosTheta * diffuseColor / PI;
                }
                samples[i]->setMaterialResponse(matresp, 0); //pdf = 0
            }
        }
    }
    public void lighting(output color Ci, Oi) {
        __radiositysample samples[];
        directlighting(this, getlights(), "mis", 1, "heuristic", "veachpower2",
                "materialsamples", samples, "diffuseresult", diff_col,
                "specularresult", spec_col);
        color indir_spec = indirectspecular(this, "materialsamples", samples);
        color indir_diff = indirectdiffuse(P, m_shadingCtx->m_Ns, num_diffuse_samps);
        Ci += (Kd * (indir_diff + diff_col) * (1-m_fres->m_Kr)) + spec_col + indir_spec;
        Ci *= Oi;
    }
}
