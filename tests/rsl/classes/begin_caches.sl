// Uniform tables made once.
class begin_caches(uniform float bands = 6; uniform color a = color(1, 0.3, 0.1), b = color(0.1, 0.2, 0.6);)
{
    uniform color m_ramp[];
    uniform float m_edges[];
    constant float m_width = 1 / bands;
    public void construct()
    {
        uniform float i;
        resize(m_ramp, bands);
        resize(m_edges, bands + 1);
        for (i = 0; i < bands; i += 1) {
            m_ramp[i] = mix(a, b, i / (bands - 1));
            m_edges[i] = i * m_width;
        }
        m_edges[bands] = 1;
    }
    public void begin()
    {
        uniform float rate = 1;
        attribute("ShadingRate", rate);
    }
    public void surface(output color Ci, Oi)
    {
        uniform float i;
        color c = 0;
        for (i = 0; i < arraylength(m_ramp); i += 1)
            c += m_ramp[i] * (step(m_edges[i], t) - step(m_edges[i + 1], t));
        Oi = Os;
        Ci = Oi * c * diffuse(normalize(faceforward(N, I)));
    }
}
