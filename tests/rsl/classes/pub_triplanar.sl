class triplanar(string maps[3] = {"", "", ""}; shader pattern = null; float blend = 4; string coordsys = "object")
{
  varying point m_P; varying vector m_w;
  void weights(output vector w) {
     normal n = ntransform(coordsys, normalize(N));
     w = vector(pow(abs(n[0]), blend), pow(abs(n[1]), blend), pow(abs(zcomp(n)), blend));
     float sum = w[0] + w[1] + w[2];
     w /= sum;
  }
  color plane(uniform float k; float a, b) {
     if (maps[k] != "") return color texture(maps[k], a, b);
     color r = color(k == 0, k == 1, k == 2);
     if (pattern != null) r *= pattern->evaluate(a, b);
     return r;
  }
  public void begin() { m_P = transform(coordsys, P); weights(m_w); }
  public void surface(output color Ci, Oi) {
     color c = 0; uniform float k;
     float us[3], vs[3];
     us[0] = m_P[1]; vs[0] = m_P[2]; us[1] = m_P[0]; vs[1] = m_P[2]; us[2] = m_P[0]; vs[2] = m_P[1];
     for (k = 0; k < 3; k += 1) c += m_w[k] * plane(k, us[k], vs[k]);
     Ci = c * Os; Oi = Os;
  }
}
