struct Ring { float radius = 1; }
surface x() {
    Ring r;
    resize(r, 3);
    Ci = r->radius;
}
//! 4:5 error RSL_NO_OVERLOAD no form of 'resize' takes (struct Ring)
