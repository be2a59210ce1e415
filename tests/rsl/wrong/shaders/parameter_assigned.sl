surface x(float Kd = 1) { Kd = Kd * 2; Ci = Kd; }
//! 1:27 warning RSL_PARAMETER_ASSIGNED not output
