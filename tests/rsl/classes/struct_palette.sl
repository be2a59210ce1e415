struct Layer {
    color tint = color(1);
    float amount = 0;
    uniform float index = 0;
    void set(color c; float a) { tint = c; amount = a; }
    color over(color below) { return mix(below, tint, amount); }
}
struct Stack {
    Layer base;
    Layer dirt;
    Layer wet;
    color evaluate() {
        color c = 0;
        c = base->over(c);
        c = dirt->over(c);
        return wet->over(c);
    }
}
class struct_palette(color baseColor = color(0.6, 0.55, 0.5); color dirtColor = color(0.2, 0.15, 0.1); float wetness = 0.3)
{
    Stack m_stack;
    public void prelighting(output color Ci, Oi)
    {
        float up = clamp(normalize(N) . normalize(vector "world" (0, 1, 0)), 0, 1);
        m_stack->base->set(baseColor, 1);
        m_stack->dirt->set(dirtColor, 0.7 * (1 - up) * noise(P * 3));
        m_stack->wet->set(0.4 * baseColor, wetness * up);
    }
    public void lighting(output color Ci, Oi)
    {
        Ci = m_stack->evaluate() * diffuse(faceforward(normalize(N), I)) * Oi;
    }
    public void postlighting(output color Ci, Oi)
    {
        Ci = pow(Ci[0], 1) * color(1, 0, 0) + Ci[1] * color(0, 1, 0) + comp(Ci, 2) * color(0, 0, 1);
    }
}
