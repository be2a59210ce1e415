float f(float a[3]) { return a[0]; }
surface x() { color c[3]; Ci = f(c); }
//! 2:34 error RSL_TYPE_MISMATCH argument 1 of 'f'
