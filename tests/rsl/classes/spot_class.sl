class spot_class(float intensity = 10; color lightcolor = 1; float coneangle = 0.6, conedelta = 0.1; point from = point "shader" (0,0,0); vector axis = vector "shader" (0,0,1);)
{
    constant float m_cosout = cos(coneangle);
    constant float m_cosin = cos(coneangle - conedelta);
    public void light(output vector L; output color Cl)
    {
        illuminate(from, axis, coneangle) {
            float c = (L . axis) / length(L) / length(axis);
            Cl = intensity * lightcolor * smoothstep(m_cosout, m_cosin, c) / (L . L);
        }
    }
}
