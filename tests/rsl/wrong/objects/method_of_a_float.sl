surface x() {
    float a = 1;
    a->init();
    Ci = a;
}
//! 3:5 error RSL_NOT_STRUCT '->' needs a struct, and 'a' is none
