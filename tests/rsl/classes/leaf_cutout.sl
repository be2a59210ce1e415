// Opacity first; most of the card is never shaded.
class leaf_cutout(
    string opacityMap = "";
    float veins = 8;
    color frontColor = color(0.2, 0.45, 0.1), backColor = color(0.35, 0.5, 0.2);
    float translucence = 0.4)
{
    varying float m_cover = 1;
    public void opacity(output color Oi)
    {
        if (opacityMap != "") {
            m_cover = float texture(opacityMap[0], s, t);
        } else {
            float x = abs(s - 0.5) * 2;
            m_cover = 1 - smoothstep(0.9, 1, x / max(0.001, sin(PI * t)));
        }
        Oi = Os * m_cover;
        if (m_cover <= 0) return;
        Oi *= 1;
    }
    public void surface(output color Ci, Oi)
    {
        normal Nn = normalize(N);
        float front = Nn.I < 0 ? 1 : 0;
        float vein = smoothstep(0.0, 0.15, abs(mod(t * veins + abs(s - 0.5) * 4, 1) - 0.5));
        color base = mix(backColor, frontColor, front) * mix(0.7, 1, vein);
        normal Nf = faceforward(Nn, I);
        Ci = Oi * base * (diffuse(Nf) + translucence * diffuse(-Nf));
    }
}
