// class: displacement and surface in one: the members that one writes are read by the other
class class_displaced_surface(float amount = 0.1; output varying float aov_height = 0;) {
    varying float height = 0;
    public void displacement(output point P; output normal N) {
        height = amount * sin(s * 9) * t;
        P += height * normalize(N);
    }
    public void opacity(output color Oi) { Oi = step(0, height + 0.05) * Os; }
    public void surface(output color Ci, Oi) {
        aov_height = height;
        Ci = Oi * color(height, 0.5, 1) * (normalize(N) . normalize(-I));
    }
}
