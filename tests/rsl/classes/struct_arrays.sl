struct Ring { float radius = 0.1; float width = 0.02; color tint = color(1, 1, 1); }
class struct_arrays(uniform float count = 5; float width = 0.03;)
{
    Ring rings[];
    public void construct()
    {
        uniform float i;
        resize(rings, count);
        for (i = 0; i < count; i += 1) {
            rings[i]->radius = (i + 1) / (count + 1) * 0.5;
            rings[i]->width = width;
            rings[i]->tint = color "hsv" (i / count, 0.8, 0.9);
        }
    }
    public void surface(output color Ci, Oi)
    {
        float r = distance(point(s, t, 0), point(0.5, 0.5, 0));
        uniform float i;
        color c = color(0.05);
        for (i = 0; i < arraylength(rings); i += 1) {
            float inside = smoothstep(rings[i]->radius - rings[i]->width, rings[i]->radius, r) - smoothstep(rings[i]->radius, rings[i]->radius + rings[i]->width, r);
            c = mix(c, rings[i]->tint, inside);
        }
        Oi = Os; Ci = c * Oi;
    }
}
