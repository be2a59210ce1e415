float half(float a b c) { return a / 2; }
flaot quarter(float a; float b = ;) { return a / 4; }
surface x(float Ka = ; color tint = (1, 0;) {
    float roughness = (1 + , gloss = 2;
    for (float i = ; i < 3; i += 1) Ci += i;
    Ci = Ka * tint * roughness * gloss * quarter(s, t) * half(s);
    Oi = other * half(s);
}
surface y() { Ci = Ka; }
//! 1:20 error RSL_SYNTAX expected ',' or ')' before 'b'
//! 2:1 error RSL_UNKNOWN_TYPE did you mean 'float'?
//! 2:34 error RSL_SYNTAX expected an expression before ';'
//! 3:22 error RSL_SYNTAX expected an expression before ';'
//! 3:42 error RSL_SYNTAX expected ')' before ';'
//! 4:28 error RSL_SYNTAX expected an expression before ','
//! 5:20 error RSL_SYNTAX expected an expression before ';'
//! 7:10 error RSL_UNKNOWN_VARIABLE unknown variable 'other'
//! 9:20 error RSL_UNKNOWN_VARIABLE unknown variable 'Ka'
