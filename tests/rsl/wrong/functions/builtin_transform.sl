surface x() { point q = transform(P, "shader"); Ci = 1; }
//! 1:25 error RSL_NO_OVERLOAD takes (point, string)
