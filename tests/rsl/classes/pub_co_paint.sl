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
class co_paint(color tint = color(1,0,0); float amount = 1; uniform string __category = "";) {
    public void getLayer(output LayerData d) {
        d->diffuse = tint;
        d->specular = 1;
        d->roughness = 0.25;
        d->presence = amount;
    }
}
