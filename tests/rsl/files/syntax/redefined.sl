surface x(float a = 1;) {
    float b;
    color b;
    { float b; b = 1; }
    Ci = b * a;
}
float f(float a) { return a; }
float f(float b) { return b; }
//! 8:7 warning RSL_FUNCTION_REDEFINED function 'f' is already defined with these parameters
//! 3:11 warning RSL_REDECLARED 'b' is already declared in this scope
