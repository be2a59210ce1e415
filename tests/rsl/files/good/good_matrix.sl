surface x(matrix m = (1,0,0,0, 0,1,0,0, 0,0,1,0, 0,0,0,1);) {
    matrix r = rotate(m, PI / 4, (0, 1, 0)) * translate(m, (1, 2, 3)) / m;
    float d = determinant(r) + comp(r, 1, 2);
    setcomp(r, 3, 0, d);
    if (r == m) r = 1;
    Ci = transform(r, P);
}
