#define SHADE(c) ((c) * Kd)
surface x() {
    Ci = SHADE(Cs);
}
//! 3:10 error RSL_UNKNOWN_VARIABLE unknown variable 'Kd'
