// struct: methods that read and write members, call each other, and are overloaded; structs as arguments and results
struct Frame {
    vector across = 0;
    vector along = 0;
    normal up = 0;
    private float ready = 0;
    public void init(normal n) {
        up = normalize(n);
        across = normalize(dPdu);
        build();
    }
    void build() {
        along = up ^ across;
        this->ready += 1;
    }
    float isready() { return ready > 0; }
    vector local(vector v) {
        if (ready == 0) return v;
        return vector(v . across, v . along, v . up);
    }
    float local(float x) { return x * ready; }
    void reset(output Frame other) {
        other->up = up;
        other->build();
    }
}
struct Pair { float a = 1; float b = 2; }
float total(Pair p) { return p->a + p->b; }
float total(Frame f) { return f->up . f->across; }
void swap(output Pair p) {
    float old = p->a;
    p->a = p->b;
    p->b = old;
}
Pair made(float a; float b) {
    Pair p;
    p->a = a;
    p->b = b;
    if (a > b) return ordered(p);
    return p;
}
Pair ordered(Pair p) {
    Pair q = p;
    swap(q);
    return q;
}
surface struct_methods(output varying vector aov_local = 0; output varying float aov_sum = 0;) {
    Frame f, g;
    f->init(N);
    if (f->isready()) aov_local = f->local(vector(s, t, 1));
    f->reset(g);
    Pair p = made(s, t), several[3];
    swap(p);
    swap(several[1]);
    p = made(p->a, p->b * 2);
    float total = total(several[1]) * 3 + total(p) + total(f);
    aov_sum = total + g->isready() + f->local(2) + several[1]->a;
    Ci = color aov_local + aov_sum;
    Oi = 1;
}
