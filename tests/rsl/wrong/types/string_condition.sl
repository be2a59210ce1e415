surface x(string map = "") { if (map) Ci = 1; }
//! 1:34 warning RSL_STRING_CONDITION != ""
