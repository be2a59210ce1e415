surface x() {
    if (s > 0.5 & t > 0.5) Ci = 1;
    if (s > 0.5 | t > 0.5) Ci = 1;
}
//! 2:17 error RSL_NOT_RSL write '&&'
//! 3:17 error RSL_NOT_RSL write '||'
