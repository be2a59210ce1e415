// matrix constants, products, comparison, transform by a matrix
surface expression_matrix() {
    matrix a = (1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 3, 0, 4, 5, 6, 1);
    matrix b = 2, c = matrix "world" 1, d = matrix "shader"(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);
    matrix e = a * b / a;
    float same = (b == matrix 2) + (a != b) + (c == c);
    point p = transform(a, P);
    vector v = vtransform(a, vector N);
    normal n = ntransform(a, N);
    setcomp(a, 0, 3, s);
    Ci = color p * 0.01 + color v * 0.1 + color n * 0.1 + same * 0.1 + determinant(a) * 0.01;
    Ci += comp(d, 1, 1) * 0.1 + color(transform(mtransform("shader", "world", a), P)) * 0.01;
}
