// Blinn-Phong of one's own with both sample methods.
class phong_mis(color diffuseColor = 0.5; color specColor = 0.5; float exponent = 40; uniform float nspec = 8;)
{
    varying normal m_Nn;
    varying vector m_Vn;
    public void begin()
    {
        m_Nn = normalize(faceforward(N, I));
        m_Vn = -normalize(I);
    }
    float pdfOf(vector Ln)
    {
        vector H = normalize(Ln + m_Vn);
        float NdotH = max(0, m_Nn . H);
        return (exponent + 1) * pow(NdotH, exponent) / (2 * PI) / max(1e-6, 4 * (H . m_Vn));
    }
    color responseOf(vector Ln)
    {
        vector H = normalize(Ln + m_Vn);
        float c = max(0, m_Nn . Ln);
        return c * specColor * (exponent + 2) / (8 * PI) * pow(max(0, m_Nn . H), exponent);
    }
    public void evaluateSamples(string distribution; output __radiancesample samples[])
    {
        uniform float numSamps = arraylength(samples);
        uniform float i;
        if (distribution == "diffuse") {
            for (i = 0; i < numSamps; i += 1) {
                float cosTheta = max(0, (samples[i]->direction) . m_Nn);
                samples[i]->setMaterialResponse(cosTheta * diffuseColor / PI, 0);
            }
        }
        else if (distribution == "specular") {
            for (i = 0; i < numSamps; i += 1) {
                vector Ln = samples[i]->direction;
                samples[i]->setMaterialResponse(responseOf(Ln), pdfOf(Ln));
            }
        }
    }
    public void generateSamples(string distribution; output __radiancesample samples[])
    {
        if (distribution != "diffuse") {
            uniform float start = arraylength(samples), i;
            uniform float size = start + nspec;
            resize(samples, size);
            vector T = normalize(m_Nn ^ m_Vn + vector(1e-4, 0, 0)), B = m_Nn ^ T;
            for (i = start; i < size; i += 1) {
                float r1 = random(), r2 = random();
                float ct = pow(r1, 1 / (exponent + 1)), st = sqrt(max(0, 1 - ct * ct));
                vector H = st * cos(2 * PI * r2) * T + st * sin(2 * PI * r2) * B + ct * m_Nn;
                vector Ln = reflect(-m_Vn, H);
                float pdf = (Ln . m_Nn) > 0 ? pdfOf(Ln) : 0;
                samples[i]->setMaterialSamples(responseOf(Ln), pdf, Ln, 1e30);
            }
        }
    }
    public void diffuselighting(output color Ci, Oi)
    {
        color d = 0;
        directlighting(this, getlights(), "diffuseresult", d);
        Ci += d;
    }
    public void specularlighting(output color Ci, Oi)
    {
        color sp = 0;
        Oi = Os;
        directlighting(this, getlights(), "specularresult", sp);
        Ci += sp;
        Ci *= Oi;
    }
}
