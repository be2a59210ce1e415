// prelighting caches, postlighting composites; private helpers after use; forward use
class phases(color c0 = color(.5); float exposure = 0; uniform float usecache = 1;)
{
  varying color m_base; varying color m_lit = 0; varying float m_done = 0;
  public void begin() { m_done = 0; }
  public void prelighting(output color Ci, Oi) { m_base = pattern(s, t) * c0; }
  public void diffuselighting(output color Ci, Oi, Ii) {
     m_lit = helper(1);
     Ii = m_lit;
     Ci += m_base * m_lit;
  }
  public void specularlighting(output color Ci, Oi) { color keep = Ci; Ci = keep + 0.25; }
  public void postlighting(output color Ci, Oi) { Ci = Ci * pow(2, exposure) * Oi; m_done += 1; }
  color pattern(float a, b) { return color(a, b, helper(0.5)); }
  float helper(float q) { return q * 2; }
}
