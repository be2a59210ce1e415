float pick(float a) { return a; }
surface x(float k = 1;) {
    uniform float fine = pick(k);
    uniform float wrong = pick(u);
    Ci = fine + wrong;
}
//! 4:27 error RSL_UNIFORM_FROM_VARYING varying value assigned to uniform 'wrong'
