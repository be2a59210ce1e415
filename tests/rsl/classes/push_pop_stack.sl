class push_pop_stack(uniform float depth = 6; float angle = 0.4;)
{
    public void surface(output color Ci, Oi)
    {
        point stack[];
        float sizes[];
        reserve(stack, 64);
        reserve(sizes, 64);
        push(stack, point(0.5, 0, 0));
        push(sizes, 0.5);
        color c = 0;
        float turns = 0;
        while (arraylength(stack) > 0 && turns < 20) {
            point p = pop(stack);
            float z = pop(sizes);
            c += 0.2 * (1 - smoothstep(0.01, 0.03, ptlined(p, p + vector(0, z, 0), point(s, t, 0))));
            if (z > 0.2) {
                push(stack, p + vector(z * sin(angle), z, 0)); push(sizes, z * 0.6);
                push(stack, p + vector(-z * sin(angle), z, 0)); push(sizes, z * 0.6);
            }
            turns += 1;
        }
        Oi = Os;
        Ci = Oi * c;
    }
}
