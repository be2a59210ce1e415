surface x() {
    uniform float a = s;
    varying float b = 1;
    uniform float c;
    c = b * 2;
    Ci = a + c;
}
//! 2:23 error RSL_UNIFORM_FROM_VARYING varying value assigned to uniform 'a'
//! 5:5 error RSL_UNIFORM_FROM_VARYING varying value assigned to uniform 'c'
