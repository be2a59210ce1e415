// return in the body of a shader, and statements joined by commas
surface control_return(float limit = 0.25) {
    float a, b;
    a = s, b = t;
    Oi = 1;
    if (a < limit) {
        Ci = Cs;
        return;
    }
    float half(float x) { return x * 0.5; }
    Ci = b > 0.5 ? half(a) : 0.1, Oi *= 0.5;
}
