void f(output float a) { a = 1; }
surface x() {
    float b;
    color c;
    f(b);
    f(b + 1);
    f(c);
    fresnel(I, N, 1.5, b, 2);
    Ci = b * c;
}
//! 6:7 error RSL_OUTPUT_ARGUMENT argument 1 of 'f' is written to and must be a variable
//! 7:7 error RSL_OUTPUT_TYPE argument 1 of 'f' must be a variable of type float, this is color
//! 8:27 error RSL_OUTPUT_ARGUMENT argument 5 of 'fresnel' is written to and must be a variable
