surface x(float mode = 1) {
    switch (mode) { Ci = 1; }
    Oi = 1;
}
//! 2:5 error RSL_NOT_RSL write 'if ... else if ...'
