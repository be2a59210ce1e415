float f(float a; output float b) { a = 1; b = a; return b; }
surface x(float k = 1; output float aov = 0;) {
    k = 2;
    k = 3;
    aov = 1;
    Ci = f(k, aov);
}
//! 1:36 warning RSL_PARAMETER_ASSIGNED parameter 'a' is assigned but not output; the change stays inside
//! 3:5 warning RSL_PARAMETER_ASSIGNED parameter 'k' is assigned but not output; the change stays inside
