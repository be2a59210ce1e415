class dispatch(shader a = null; shader b = null; shader c = null) {
  public void surface(output color Ci, Oi) {
    shader s1 = s < 1 ? a : b;
    if (t > 0) s1 = c;
    color col = 0; float f = 0;
    if (s1 != null) { s1->shade(col, f); col += s1->bias; }
    Ci = col; Oi = f;
  }
}
