class softbox_light(
    float intensity = 1;
    color lightcolor = color(1, 1, 1);
    float width = 2, height = 1;
    string __category = "key";
    float __nondiffuse = 0;)
{
    public void light(output vector L; output color Cl)
    {
        point Pl = transform("shader", Ps);
        float x = xcomp(Pl), y = ycomp(Pl);
        point closest = transform("shader", "current", point(clamp(x, -width / 2, width / 2), clamp(y, -height / 2, height / 2), 0));
        L = Ps - closest;
        float d2 = L . L;
        Cl = intensity * lightcolor / max(d2, 1e-4);
    }
}
