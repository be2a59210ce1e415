surface x() { illuminance() { Ci += Cl; } }
//! 1:15 error RSL_ARGUMENT_FORM illuminance takes
