class writeaov_class(color base = color(0.4, 0.5, 0.6);)
{
    public void surface(output color Ci, Oi)
    {
        normal Nf = faceforward(normalize(N), I);
        color d = base * diffuse(Nf);
        color sp = specular(Nf, -normalize(I), 0.1);
        float facing = abs(Nf . normalize(I));
        writeaov("diffuse", d);
        writeaov("specular", sp);
        writeaov("facing", facing);
        writeaov("normal", Nf);
        Oi = Os;
        Ci = Oi * (d + sp);
    }
}
