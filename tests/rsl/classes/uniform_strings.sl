class uniform_strings(uniform string mapnames[] = {"a.tex", "b.tex"}; uniform string prefix = "maps"; uniform float which = 0)
{
    uniform string m_file = "";
    public void construct()
    {
        if (which < arraylength(mapnames)) {
            m_file = concat(prefix, "/", mapnames[which]);
        }
        else {
            m_file = format("%s/%d.tex", prefix, which);
        }
    }
    public void surface(output color Ci, Oi)
    {
        float exists = 0;
        Ci = color(s, t, 0);
        if (textureinfo(m_file, "exists", exists) != 0 && exists == 1) Ci = texture(m_file, s, t);
        Oi = Os;
    }
}
