surface x() {
    float a = 1 + ;
    Ci = a * b;
}
surface y() { Ci = Cs; }
//! 2:19 error RSL_SYNTAX expected an expression
//! 3:14 error RSL_UNKNOWN_VARIABLE 'b'
