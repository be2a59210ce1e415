// functions without a type: float, or nothing where nothing is returned
square(float x) { return x * x; }
brighten(output color c; float by) { c *= by; }
surface function_untyped() {
    Ci = Cs * square(s);
    brighten(Ci, 0.5);
}
