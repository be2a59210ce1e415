class extern_class_members(float amp = .1; float freq = 7)
{
    varying float m_bump = 0;
    varying normal m_saved = 0;
    void bump(float size)
    {
        extern normal N;
        extern point P;
        extern float s, t;
        float h = size * sin(s * freq * 2 * PI) * sin(t * freq * 2 * PI);
        m_bump += h;
        N = normalize(calculatenormal(P + h * normalize(N)));
    }
    public void displacement(output point P; output normal N)
    {
        m_saved = N;
        bump(amp);
        bump(amp / 2);
    }
    public void surface(output color Ci, Oi)
    {
        Oi = Os;
        Ci = Oi * (color(0.5) + m_bump) * diffuse(faceforward(normalize(mix(N, m_saved, 0.3)), I));
    }
}
