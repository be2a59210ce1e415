class matrix_projector(uniform string space = "shader"; uniform matrix place = matrix "shader" 1; float gain = 1; color a = color(0.9, 0.2, 0.1), b = color(0.95);)
{
    varying float m_s, m_t;
    varying float m_mask = 0;
    void project(point p; output float ss, tt;)
    {
        point q = transform(space, p);
        ss = xcomp(q) + .5;
        tt = ycomp(q) + .5;
    }
    public void begin()
    {
        project(P, m_s, m_t);
        m_mask = (m_s >= 0 && m_s <= 1 && m_t >= 0 && m_t <= 1);
    }
    public void surface(output color Ci, Oi)
    {
        float check = mod(floor(m_s * 8) + floor(m_t * 8), 2) == 0;
        float x = m_mask > 0 && check;
        Oi = Os;
        Ci = Oi * gain * mix(b, a, x);
    }
}
