surface x() {
    color c = 0;
    gather("illuminance", P, N) { Ci += c; }
    gather("illuminance", P, N, PI / 2, 16, "surface:Ci", c * 2) { Ci += c; }
    gather("illuminance", P, N, PI / 2, 16, "bias") { Ci += c; }
}
//! 3:5 error RSL_ARGUMENT_FORM gather takes (category, position, direction, angle, samples [, "name", value ...])
//! 4:59 error RSL_OUTPUT_ARGUMENT argument 2 of 'gather' is written to and must be a variable
//! 5:5 error RSL_ARGUMENT_FORM gather takes (category, position, direction, angle, samples [, "name", value ...])
