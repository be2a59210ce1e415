class volume_smoke(float density = 0.5; color tint = color(0.8, 0.85, 0.9); uniform float steps = 16;)
{
    float m_len = 0;
    public void begin() { m_len = length(I); }
    float dens(point p) { return density * max(0, float noise(p * 0.7) - 0.3); }
    public void volume(output color Ci, Oi)
    {
        uniform float i;
        float opticaldepth = 0, dx = m_len / steps;
        vector dir = normalize(I);
        for (i = 0; i < steps; i += 1)
            opticaldepth += dens(P - dir * (i + 0.5) * dx) * dx;
        float a = 1 - exp(-opticaldepth);
        Ci = mix(Ci, tint, a);
        Oi = mix(Oi, color 1, a);
    }
}
