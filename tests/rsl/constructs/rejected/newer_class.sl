// class, struct, public: RSL 2.0 (one clear error)
class newer_class(float a = 1;) {
    float member;
    public void surface(output color Ci, Oi) { Ci = a -> b; member = undefined; }
}
