#ifndef GRAIN_H
#define GRAIN_H
struct Grain
{
    public uniform float frequency = 8;
    public varying float value = 0;
    public varying point where;
    public void init(uniform float f; point p)
    {
        frequency = f;
        where = p;
        evaluate();
    }
    private void evaluate()
    {
        float r = sqrt(xcomp(where) * xcomp(where) + ycomp(where) * ycomp(where));
        r += 0.1 * noise(where * 2);
        value = mod(r * frequency, 1);
        value = smoothstep(0, 0.8, value) - smoothstep(0.83, 1, value);
    }
};
#endif
class wood_struct_header(uniform float ringscale = 10; color light = color(0.7, 0.45, 0.2); color dark = color(0.35, 0.17, 0.06); float Ks = 0.2, roughness = 0.1;)
{
    Grain g;
    public void prelighting(output color Ci; output color Oi)
    {
        g->init(ringscale, transform("object", P));
    }
    public void lighting(output color Ci; output color Oi)
    {
        normal Nf = faceforward(normalize(N), I);
        color c = mix(light, dark, g->value);
        Oi = Os;
        Ci = Oi * (c * (ambient() + diffuse(Nf)) + Ks * (1 - 0.5 * g->value) * specular(Nf, normalize(-I), roughness));
    }
}
