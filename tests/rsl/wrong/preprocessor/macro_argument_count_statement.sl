#define SAY(x)
surface x() {
    SAY("a", s) Ci = 1;
}
//! 3:5 error RSL_MACRO_ARGUMENTS takes 1 argument(s), 2 given
