surface x() {
    color c = 0;
    gather("illuminance", P, N, PI / 2, 16, "surface:Ci", c) { Ci += c; } else { Ci += 1; }
}
//! 3:5 error RSL_NOT_SUPPORTED gather is not supported yet
