// nested functions capture locals, with and without extern
surface function_nested(float gain = 2) {
    float base = s * 0.5;
    color tint = Cs;
    float boosted(float x) {
        extern float base;
        extern float gain;
        return x * gain + base;
    }
    color tinted(float x) { return tint * boosted(x); }
    uniform float halved(uniform float x) { return x / 2; }
    void lift() { extern color tint; tint += 0.1; }
    lift();
    Ci = tinted(t) * halved(gain);
}
