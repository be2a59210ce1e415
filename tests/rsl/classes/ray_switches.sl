class ray_switches(color a = color(1, 0, 0); color b = color(0, 0, 1))
{
    uniform string m_type = "camera";
    uniform float m_shadow = 0;
    public void begin()
    {
        rayinfo("type", m_type);
        m_shadow = m_type == "transmission";
    }
    public void opacity(output color Oi)
    {
        if (m_shadow == 1) { Oi = 0.5; return; }
        Oi = Os;
    }
    public void surface(output color Ci, Oi)
    {
        string intent = "";
        float known = rayinfo("shadingintent", intent);
        Ci = (m_type == "camera" ? a : b) * Oi;
        if (known == 1 && intent == "cache") Ci *= 0.5;
    }
}
