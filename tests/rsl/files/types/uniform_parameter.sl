float twice(uniform float x) { return x * 2; }
surface x(float k = 1;) {
    Ci = twice(k) + twice(t);
}
//! 3:27 warning RSL_UNIFORM_ARGUMENT varying value passed to uniform parameter 'x' of 'twice'
