surface x() {
    if (s > 0.5 and not t or t > 0.2 + u and nosuch) Ci = 1;
    if (not (s > 0.5)) Ci = 2;
}
//! 2:17 error RSL_NOT_RSL write '&&'
//! 2:21 error RSL_NOT_RSL write '!'
//! 2:27 error RSL_NOT_RSL write '||'
//! 2:42 error RSL_NOT_RSL write '&&'
//! 2:46 error RSL_UNKNOWN_VARIABLE unknown variable 'nosuch'
//! 3:9 error RSL_UNKNOWN_FUNCTION write '!'
