surface x(float k = 2;) {
    float depth = 1;
    float outer(float a) {
        float local = a + depth;
        float inner(float b) { return b * local * k; }
        return inner(a) + inner(local);
    }
    void bump(output float a) { a += k; depth += s; }
    bump(depth);
    Ci = outer(depth);
}
