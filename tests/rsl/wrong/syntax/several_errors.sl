surface x(float Kd = 1) {
    color c = Kdd * Cs;
    float f = N;
    c += nosuch(f) * undefined;
    point p = "a";
    Ci = c;
}
//! 2:15 error RSL_UNKNOWN_VARIABLE 'Kdd'
//! 3:15 error RSL_TYPE_MISMATCH needs float, this is normal
//! 4:10 error RSL_UNKNOWN_FUNCTION 'nosuch'
//! 4:22 error RSL_UNKNOWN_VARIABLE 'undefined'
//! 5:15 error RSL_TYPE_MISMATCH this is string
