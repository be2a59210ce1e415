surface x() { Ci = Cl; }
//! 1:20 warning RSL_ONLY_IN_ILLUMINANCE 'Cl' is only known inside illuminance
