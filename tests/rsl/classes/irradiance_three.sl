class irradiance_three(color albedo = color(0.5, 0.6, 0.7);)
{
    public void diffuselighting(output color Ci, Oi, Ii)
    {
        normal Nf = normalize(faceforward(N, I));
        Ii = diffuse(Nf) + indirectdiffuse(P, Nf, 16, "maxvariation", 0.02);
        Ci = albedo * Ii;
    }
    public void specularlighting(output color Ci, Oi)
    {
        vector R = reflect(normalize(I), normalize(faceforward(N, I)));
        Ci += 0.1 * trace(P, R);
    }
}
