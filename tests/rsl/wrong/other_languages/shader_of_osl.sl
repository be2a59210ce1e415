shader x(float Kd = 1) { Ci = Kd; }
//! 1:1 error RSL_NOT_RSL Open Shading Language
