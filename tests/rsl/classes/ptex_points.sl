class ptex_points(string pointcloud = ""; color fallback = color(0.5); float Kd = 1)
{
    public void surface(output color Ci, Oi)
    {
        color baked = 0;
        float area = 0;
        float ok = 0;
        if (pointcloud != "")
            ok = texture3d(pointcloud, P, N, "_radiosity", baked, "_area", area);
        if (ok == 0) baked = fallback;
        filterregion fr;
        fr->calculate2d(s, t);
        Ci = Os * Kd * baked;
        Oi = Os;
    }
}
