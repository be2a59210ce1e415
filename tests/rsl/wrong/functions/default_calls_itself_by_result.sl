// Each call leaves out arguments whose defaults do the same; told once, not four hundred levels deep.
float spot(float x; float y = spot(x) + spot(x) * spot(2); float z = spot(3)) { return x + y + z; }
color spot(float x; float y = spot(x) + spot(x) * spot(2); float z = spot(3)) { return color(x, y, z); }
surface x() { Ci = spot(s) + spot(t); }
//! 2:31 error RSL_TOO_DEEP nested too deeply: at most 4 defaults
