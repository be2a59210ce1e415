surface one(string name = "kept") {
    writeaov(name, Cs);
    Ci = Cs;
}
surface other() { Ci = Cs; }
//! 2:5 error RSL_ARGUMENT_FORM writeaov takes a constant string
