surface x() {
    uniform float a = unknown;
    uniform float b = nosuch(P);
    uniform float c = s + unknown;
    Ci = a * b * c;
}
//! 2:23 error RSL_UNKNOWN_VARIABLE unknown variable 'unknown'
//! 3:23 error RSL_UNKNOWN_FUNCTION unknown function 'nosuch'
//! 4:23 error RSL_UNIFORM_FROM_VARYING declare it varying
