surface x() {
    Ci = tan(P);
    Ci = texture(3);
    Ci = mix(1, 2);
}
//! 2:10 error RSL_NO_OVERLOAD no form of 'tan' takes (point)
//! 3:10 error RSL_NO_OVERLOAD no form of 'texture' takes (float)
//! 4:10 error RSL_NO_OVERLOAD no form of 'mix' takes (float, float)
