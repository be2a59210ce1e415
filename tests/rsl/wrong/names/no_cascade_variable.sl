surface x() {
    color c = tint * 2 + Cs;
    c = mix(c, tint, comp(tint, 0)) + texture(tint);
    Ci = c . tint + sin(c * tint);
}
//! 2:15 error RSL_UNKNOWN_VARIABLE 'tint'
