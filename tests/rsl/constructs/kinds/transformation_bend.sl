// a transformation (deformation) moves P
transformation transformation_bend(float amount = 0.3) {
    point q = P;
    setxcomp(q, xcomp(P) + amount * ycomp(P) * ycomp(P));
    P = q;
}
