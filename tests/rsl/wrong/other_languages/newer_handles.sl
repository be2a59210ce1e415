surface x(uniform shader co = null;) { Ci = co * 2; }
//! 1:45 error RSL_HANDLE_AS_VALUE a shader is no value that this can use
