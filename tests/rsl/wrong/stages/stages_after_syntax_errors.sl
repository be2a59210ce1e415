surface x() {
    color c = L * 2;
    illuminate(P) { Ci = length(; }
}
imager y() {
    Ci = s;
    illuminance(P) { Ci += Cl; }
}
//! 3:33 error RSL_SYNTAX expected an expression before ';'
//! 3:5 error RSL_STATEMENT_NOT_LEGAL illuminate cannot be used in surface shaders
//! 6:10 warning RSL_GLOBAL_NOT_READABLE 's' is not available in imager shaders; here it is 0
//! 7:5 error RSL_STATEMENT_NOT_LEGAL illuminance cannot be used in imager shaders
//! 7:28 warning RSL_GLOBAL_NOT_READABLE 'Cl' is not available in imager shaders; here it is 0
