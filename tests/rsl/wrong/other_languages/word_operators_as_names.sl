surface x(float and = 1; float not = 2) {
    float or = and + not;
    Ci = or;
    Oi = and and or;
}
//! 4:14 error RSL_NOT_RSL write '&&'
