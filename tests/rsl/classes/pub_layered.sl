// Layers in the manner of RMS / slim co-shader palettes
struct LayerData {
    varying color diffuse = color(0);
    varying color specular = 0;
    varying float roughness = .1;
    varying float presence = 1;
    void reset() { diffuse = 0; specular = 0; roughness = 0.1; presence = 1; }
    void over(LayerData b; float a) {
        diffuse = mix(b->diffuse, diffuse, a);
        specular = mix(b->specular, specular, a);
        roughness = mix(b->roughness, roughness, a);
    }
};
class layers(
    shader baseLayer = null;
    shader topLayers[] = {};
    uniform string layerCategory = "layer";
    output varying color aov_diffuse = 0;
    )
{
    LayerData m_data;
    private void collect() {
        LayerData tmp;
        m_data->reset();
        if (baseLayer != null)
            baseLayer->getLayer(m_data);
        uniform float i, n = arraylength(topLayers);
        for (i = 0; i < n; i += 1) {
            shader l = topLayers[i];
            if (l != null && hasmethod(l, "getLayer") == 1) {
                tmp->reset();
                l->getLayer(tmp);
                tmp->over(m_data, tmp->presence);
                m_data = tmp;
            }
        }
        shader more[] = getshaders("category", layerCategory);
        for (i = 0; i < arraylength(more); i += 1) {
            tmp->reset();
            more[i]->getLayer(tmp);
            tmp->over(m_data, tmp->presence);
            m_data = tmp;
        }
    }
    public void prelighting(output color Ci, Oi) { collect(); }
    public void lighting(output color Ci, Oi) {
        normal Nf = faceforward(normalize(N), I);
        color spec = 0;
        aov_diffuse = m_data->diffuse;
        Ci = Oi * (m_data->diffuse + m_data->specular * m_data->roughness);
    }
}
