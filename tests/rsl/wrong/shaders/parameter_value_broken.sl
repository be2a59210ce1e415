surface x(matrix m = (1,0,0,0, 0,1,,0, 0,0,1,0, 0,0,0,1); color c = mix(+, 0, 1), d = 2; float a = (1 0, 0))
{
    Ci = c * d * nosuch;
}
//! 1:36 error RSL_SYNTAX expected an expression
//! 1:74 error RSL_SYNTAX expected an expression
//! 1:103 error RSL_SYNTAX expected ')'
//! 3:18 error RSL_UNKNOWN_VARIABLE nosuch
