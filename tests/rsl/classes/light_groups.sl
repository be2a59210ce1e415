class light_groups(color albedo = 0.5; uniform string groups[] = {"key", "fill"}; output varying color key_diffuse = 0, fill_diffuse = 0)
{
    normal m_Nn = 0;
    public void begin() { m_Nn = faceforward(normalize(N), I); }
    public void evaluateSamples(string distribution; output __radiancesample samples[])
    {
        uniform float i;
        for (i = 0; i < arraylength(samples); i += 1)
            samples[i]->setMaterialResponse(distribution == "diffuse" ? albedo * max(0, samples[i]->direction . m_Nn) / PI : color(0), 0);
    }
    public void lighting(output color Ci, Oi)
    {
        color diffuses[], unshadowed = 0, irradiance = 0, d = 0;
        Ci = directlighting(this, getlights(), "lightgroups", groups, "groupeddiffuseresults", diffuses,
                            "diffuseresult", d, "unshadoweddiffuseresult", unshadowed, "irradianceresult", irradiance);
        if (arraylength(diffuses) > 1) { key_diffuse = diffuses[0]; fill_diffuse = diffuses[1]; }
        Ci *= Oi;
    }
}
