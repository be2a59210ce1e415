surface x() {
    if (s > 0.5) then Ci = 1;
    else Ci = 0;
}
//! 2:18 error RSL_NOT_RSL leave it out
