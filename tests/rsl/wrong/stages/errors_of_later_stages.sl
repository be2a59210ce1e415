float lit(normal n) { extern point P; float r = 0; illuminance(P, n, PI / 2) r += 1; return r; }
surface x() {
    uniform float u = s;
    float f = N;
    solar() { }
    illuminance() { f = Q; }
    illuminate(P) { u = t; }
}
light y() {
    illuminate(P) { solar() { Cl = lit(N) * nothing(1); } }
    gather("illuminance", P, N) { Ci = wrong(1); } else { N = 3; }
}
//! 4:15 error RSL_TYPE_MISMATCH this is normal
//! 6:5 error RSL_ARGUMENT_FORM illuminance takes
//! 6:25 error RSL_UNKNOWN_VARIABLE 'Q'
//! 10:21 error RSL_NESTED_ILLUMINATE solar inside illuminate
//! 10:45 error RSL_UNKNOWN_FUNCTION 'nothing'
//! 11:5 error RSL_ARGUMENT_FORM gather takes
//! 11:40 error RSL_UNKNOWN_FUNCTION 'wrong'
//! 5:5 error RSL_STATEMENT_NOT_LEGAL solar
//! 7:5 error RSL_STATEMENT_NOT_LEGAL illuminate
//! 1:52 error RSL_STATEMENT_NOT_LEGAL illuminance cannot be used in light shaders
//! 11:35 warning RSL_GLOBAL_NOT_READABLE 'Ci'
//! 11:59 warning RSL_GLOBAL_NOT_WRITABLE 'N'
//! 3:23 error RSL_UNIFORM_FROM_VARYING 'u'
//! 7:21 error RSL_UNIFORM_FROM_VARYING 'u'
