surface x(uniform shader co = null;) { Ci = co->f(); }
//! 1:19 error RSL_2 'shader'
