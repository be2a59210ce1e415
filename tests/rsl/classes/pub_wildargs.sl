class wild(uniform float n = 3; varying vector dir = vector(0,0,1); normal nrm = normal(0,1,0); point pts[2] = {point(1,2,3), point(4,5,6)}; matrix mm = 1; string ss[] = {}; color cc[] = {}; float ff[3] = {1, 2, 3}; vector vv[1] = {vector(0,1,0)};) {
  void out4(output float a; output color b; output point c; output string d) { a = 1; b = color(2); c = point(3,3,3); d = "x"; }
  void inout(output float f[]) { uniform float i; for (i = 0; i < arraylength(f); i += 1) f[i] *= 2; }
  float only(varying float a; uniform float b; string c) { return a + b + (c == "k" ? 1 : 0); }
  public void surface(output varying color Ci, Oi) {
    float a; color b; point c; string d;
    out4(a, b, c, d);
    float loc[3]; loc = ff; inout(loc);
    Ci = color(a + b[0] + c[0], loc[2], only(s, n, "k"));
    Oi = color(arraylength(ss), d == "x", pts[1][2]);
  }
}
