// What displacement computes colours the surface.
class disp_and_surface(uniform float depth = 0.1, freq = 4; color low = color(0.1, 0.05, 0.02); color high = color(0.9, 0.8, 0.6);)
{
    varying float m_height;

    public void displacement(output point P; output normal N)
    {
        point pp = transform("shader", P) * freq;
        uniform float i;
        float amp = 1;
        m_height = 0;
        for (i = 0; i < 4; i += 1) {
            m_height += amp * (float noise(pp) - 0.5);
            pp *= 2.03;
            amp *= 0.5;
        }
        P = P + depth * m_height * normalize(N);
        N = calculatenormal(P);
    }
    public void surface(output color Ci; output color Oi)
    {
        color c = mix(low, high, smoothstep(-0.4, 0.4, m_height));
        Oi = Os;
        Ci = c * Oi * diffuse(faceforward(normalize(N), normalize(I)));
    }
}
