surface x() {
    float n = getlights("diffuse");
    Ci = undefined;
}
//! 2:15 error RSL_2 'getlights()' belongs to RSL 2.0
