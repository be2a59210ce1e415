class x(float a = 1;) { public void surface(output color Ci, Oi) { Ci = a; } }
//! 1:1 error RSL_2 'class'
