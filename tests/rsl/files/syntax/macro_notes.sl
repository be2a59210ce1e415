#define SQUARE(x) ((x) * undefined_name * (x))
#define TWICE(x) (SQUARE(x) + SQUARE(x))
surface x() {
    Ci = TWICE(s);
}
//! 4:10 error RSL_UNKNOWN_VARIABLE unknown variable 'undefined_name'
