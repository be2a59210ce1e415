light windowlight(point from = (0, 0, 0), to = (0, 0, 1);) {
    L = to - from;
    Cl = 1;
}
//! 2:5 warning RSL_ONLY_IN_ILLUMINATE 'L' is only known inside illuminate or solar
