class ripple_disp(float amp = 0.05; float freq = 12; float phase = 0;)
{
    public void displacement(output point P; output normal N)
    {
        varying float r = sqrt((s - 0.5) * (s - 0.5) + (t - 0.5) * (t - 0.5));
        varying float h = amp * sin(r * freq * 2 * PI - phase);
        P += h * normalize(N);
        N = calculatenormal(P);
    }
}
