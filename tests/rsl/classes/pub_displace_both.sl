class mud(float Km = 0.1; float freq = 2; string name = "shader"; float usebump = 0)
{
    varying float m_height = 0;
    private float fractal(point pp; float oct;) {
        uniform float i, f = 1;
        varying float total = 0;
        for (i = 0; i < oct; i += 1) { total += (float noise(pp * f) - 0.5) / f; f *= 2; }
        return total;
    }
    public void displacement(output point P; output normal N) {
        normal n = normalize(N);
        point pp = transform(name, P);
        m_height = fractal(pp * freq, 4);
        if (usebump == 0) {
            P += n * m_height * Km;
            N = calculatenormal(P);
        } else
            N = calculatenormal(P + n*m_height*Km);
    }
    public void surface(output color Ci; output color Oi) {
        Oi = Os;
        Ci = Os * Cs * mix(color(.2,.1,0), color(.6,.5,.3), smoothstep(-.5, .5, m_height));
    }
}
