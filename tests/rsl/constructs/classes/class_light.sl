// class: a light
class class_light(float intensity = 2; color lightcolor = 1; point from = point "shader" (0, 0, 0);) {
    uniform float power = 0;
    public void construct() { power = intensity * 3; }
    public void light(output vector L; output color Cl) {
        illuminate (from) { Cl = power * lightcolor / (L . L); }
    }
}
