surface x() { Ci = diffuse(); }
//! 1:20 error RSL_NO_OVERLOAD color diffuse(normal)
