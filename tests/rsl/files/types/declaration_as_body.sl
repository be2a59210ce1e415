surface x(float a = 1;) {
    float k = 0;
    while (k < 2) float b = k += 1;
    if (a > 1) float c = a;
    else float c = 2;
    Ci = b;
    Oi = c;
}
//! 6:10 error RSL_UNKNOWN_VARIABLE 'b'
//! 7:10 error RSL_UNKNOWN_VARIABLE 'c'
