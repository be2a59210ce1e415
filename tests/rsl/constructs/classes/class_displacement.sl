// class: a displacement, whose points and normals its helpers see under the names of the globals
class class_displacement(float amount = 0.1;) {
    float height = 0;
    void lift() {
        extern point P;
        P += height * normalize(N);
    }
    public void begin() { height = amount * (s + t * t); }
    public void displacement(output point P; output normal N) {
        lift();
        N = calculatenormal(P);
    }
}
