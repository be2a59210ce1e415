// class: parameters, members with storage, methods of the pipeline and of its own, this, overloads
struct Shading { normal n = 0; float facing = 0; void init() { extern vector I; n = normalize(N); facing = abs(normalize(I) . n); } }
class class_members(float Ka = 0.5, Kd = 0.5; color tint = color(1, 0.5, 0.25); output varying color aov_base = 0;) {
    uniform float gain = Ka * 2;
    constant float table[3] = {1, 2, 4};
    varying color base = 0;
    float list[];
    private Shading shading;
    public float visible = 1;
    color scaled(color c) { return c * gain; }
    color scaled(color c; float k) { return scaled(c) * k; }
    public void construct() {
        gain += table[1];
        resize(list, 2);
        list[0] = gain;
    }
    public void begin() {
        shading->init();
        list[1] = s;
    }
    public void opacity(output color Oi) {
        visible = s > 0.25;
        Oi = visible * Os * (1 - t * 0.5);
    }
    public void prelighting(output color Ci, Oi) {
        base = tint * (0.5 + 0.5 * shading->facing);
        this->base += list[1];
    }
    public void lighting(output color Ci; output color Oi;) {
        Ci = this->scaled(base, Kd) + ambient() + diffuse(shading->n);
    }
    public void postlighting(output color Ci, Oi) {
        aov_base = base;
        Ci *= Oi * list[0];
    }
};
