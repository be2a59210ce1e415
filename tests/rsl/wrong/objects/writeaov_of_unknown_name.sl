surface x(string name = "a";) {
    writeaov(name, Cs);
    Ci = 1;
}
//! 2:5 error RSL_ARGUMENT_FORM writeaov takes a constant string
