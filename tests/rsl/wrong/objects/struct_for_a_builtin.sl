struct A { float k; }
surface x() {
    A a;
    Ci = noise(a);
}
//! 4:10 error RSL_NO_OVERLOAD no form of 'noise' takes (struct A)
