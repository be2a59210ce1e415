#define TWICE(x) ((x) * 2)
surface x() {
    Ci = TWICE(TWICE(wrong));
}
//! 3:22 error RSL_UNKNOWN_VARIABLE unknown variable 'wrong'
