// xcomp ycomp zcomp comp setxcomp setcomp
surface component_builtins() {
    point p = P;
    color c = Cs;
    setxcomp(p, 1); setycomp(p, ycomp(P) * 2); setzcomp(p, zcomp(N));
    setcomp(c, 1, 0.5);
    Ci = color(xcomp(p), ycomp(p), zcomp(p)) * 0.1 + comp(c, 1) + xcomp(I) * 0.01 + comp(P, 2) * 0.01;
}
