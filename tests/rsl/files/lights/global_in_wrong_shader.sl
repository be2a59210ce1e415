light x() {
    Ci = 1;
    solar((0, 0, 1), 0) Cl = alpha;
}
//! 2:5 warning RSL_GLOBAL_NOT_READABLE 'Ci' is not available in light shaders
//! 3:30 warning RSL_GLOBAL_NOT_READABLE 'alpha' is not available in light shaders
