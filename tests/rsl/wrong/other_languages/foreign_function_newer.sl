surface x() {
    float n = getlights("diffuse");
    Ci = undefined;
}
//! 2:15 error RSL_2 'getlights()' belongs to the part of RSL 2.0 that is not supported yet
