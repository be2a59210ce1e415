plugin "noise.so";
//! 1:1 warning RSL_PLUGIN compiled plugins
surface x() { Ci = 1; }
