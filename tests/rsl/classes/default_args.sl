float tweak(float x; float gamma = 2.2; float gain = 1;) { return gain * pow(max(0, x), 1 / gamma); }
class default_args(color tint = 0.4)
{
    color shade(color c; float k = 0.5) { return c * k; }
    public void surface(output color Ci, Oi)
    {
        color c = shade(tint) + shade(tint, 0.25);
        Ci = color(tweak(c[0]), tweak(c[1], 1.8), tweak(c[2], 1.8, 0.9)) * Os;
        Oi = Os;
    }
}
