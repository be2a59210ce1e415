#define DECLARE(type, name) type name = 0
surface x() {
    DECLARE(float a);
    Ci = a;
}
surface y() { Ci = nosuch; }
//! 3:5 error RSL_MACRO_ARGUMENTS macro 'DECLARE' takes 2 argument(s), 1 given
//! 6:20 error RSL_UNKNOWN_VARIABLE unknown variable 'nosuch'
