class ward_params(
    float Ka = 1 ; float Kd = 0.5 ; float Ks = 0.5 ;
    float xroughness = 0.1 ; float yroughness = 0.3 ;
    color specularcolor = 1 ;
)
{
    color ward(normal Nn; vector V; vector xdir;)
    {
        float sqr(float x) { return x * x; }
        float cos_theta_r = clamp(Nn . V, 0.0001, 1);
        vector X = xdir / xroughness;
        vector Y = (Nn ^ xdir) / yroughness;
        color C = 0;
        extern point P;
        illuminance(P, Nn, PI / 2)
        {
            vector LN = normalize(L);
            float cos_theta_i = LN . Nn;
            if (cos_theta_i > 0.0) {
                vector H = normalize(V + LN);
                float rho = exp(-2 * (sqr(X . H) + sqr(Y . H)) / (1 + H . Nn)) / sqrt(cos_theta_i * cos_theta_r);
                C += Cl * (cos_theta_i * rho);
            }
        }
        return C / (4 * xroughness * yroughness);
    }
    public void surface(output color Ci, Oi)
    {
        normal Nf = faceforward(normalize(N), I);
        Oi = Os;
        Ci = Os * (Cs * (Ka * ambient() + Kd * diffuse(Nf)) + specularcolor * Ks * ward(Nf, -normalize(I), normalize(dPdu)));
    }
}
