// Functions with output arrays and open arrays.
void gatherWeights(uniform float n; varying float x; output float weights[])
{
    uniform float i;
    resize(weights, n);
    for (i = 0; i < n; i += 1) weights[i] = max(0, 1 - abs(x * (n - 1) - i));
}
float total(float values[])
{
    float sum = 0;
    uniform float i;
    for (i = 0; i < arraylength(values); i += 1)
        sum += values[i];
    return sum;
}
class array_outputs(uniform color ramp[] = {color(0.1, 0.1, 0.4), color(0.8, 0.3, 0.2), color(1, 0.9, 0.5)}; uniform float gain = 1)
{
    public void surface(output color Ci, Oi)
    {
        float weights[];
        uniform float i;
        gatherWeights(arraylength(ramp), t, weights);
        float sum = total(weights);
        Ci = 0;
        for (i = 0; i < arraylength(ramp); i += 1)
            Ci += ramp[i] * weights[i] / sum;
        Ci *= gain * Os;
        Oi = Os;
    }
}
