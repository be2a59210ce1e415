surface x() {
    if (s > 0.5) goto done;
    Ci = 1;
}
//! 2:18 error RSL_NOT_RSL 'goto'
