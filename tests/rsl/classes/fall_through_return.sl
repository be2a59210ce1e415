class fall_through_return(float cutoff = 0.5; color on = color(1, 1, 0), off = color(0.1, 0.1, 0.1))
{
    float inside(float x, y)
    {
        if (x < 0 || x > 1) return 0;
        if (y < 0 || y > 1) return 0;
        return 1;
    }
    color pick(float k)
    {
        if (k > cutoff) return on;
        else return off;
    }
    public void opacity(output color Oi)
    {
        Oi = Os;
        if (inside(s * 2 - 0.5, t * 2 - 0.5) == 0)
        {
            Oi = 0;
            return;
        }
        Oi *= 0.9;
    }
    public void surface(output color Ci, Oi)
    {
        Ci = pick(noise(s * 9, t * 9)) * Oi;
    }
}
