class gather_gloss(uniform float samples = 16; float blur = 0.1; color tint = color(0.9, 0.8, 0.6); string envname = "")
{
    public void surface(output color Ci, Oi)
    {
        normal Nf = faceforward(normalize(N), I);
        vector R = reflect(normalize(I), Nf);
        color hitc = 0, sum = 0;
        uniform float depth = 0;
        rayinfo("depth", depth);
        uniform float n = max(1, floor(samples / pow(4, depth)));
        gather("illuminance", P, R, blur, n, "surface:Ci", hitc) {
            sum += hitc;
        } else {
            if (envname != "") sum += color environment(envname, R);
        }
        Oi = Os;
        Ci = Oi * tint * sum / n;
    }
}
