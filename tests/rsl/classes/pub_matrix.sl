class matrices(matrix m = matrix "shader" 1; float angle = 90; point pivot = point "shader" (1,0,0);) {
  uniform matrix m_rot = 1; uniform matrix list[2] = {1, 2};
  public void construct() { m_rot = rotate(matrix 1, radians(angle), vector(0,0,1)); list[1] = m_rot * list[1]; }
  public void surface(output color Ci, Oi) {
    point p = transform(m_rot, P);
    matrix inv = 1 / m_rot;
    point q = transform(inv, p);
    vector v = vtransform(list[1], vector(1,0,0));
    float d = determinant(m_rot);
    Ci = color p; Oi = color(distance(q, P) < 1e-5, v[1], d);
  }
}
