surface x(float a = 1)
    float b = a * 2;
    Ci = b * c;
}
surface y(float a = 1) { Ci = a; }
//! 1:23 error RSL_SYNTAX expected '{'
//! 3:14 error RSL_UNKNOWN_VARIABLE 'c'
