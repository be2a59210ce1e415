surface x() {
    illuminance(P, N, "category") Ci += Cl;
}
//! 2:5 error RSL_ARGUMENT_FORM illuminance takes
