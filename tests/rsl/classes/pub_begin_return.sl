class early(uniform float mode = 0; float cut = .5) {
  varying float m_a = 0; 
  public void begin() { if (mode == 1) return; m_a = s; if (m_a < cut) { return; } m_a += 10; }
  public void opacity(output color Oi) { if (s > 2) { Oi = 0; return; } Oi = 1; }
  public void surface(output color Ci, Oi) {
    Ci = m_a;
    if (m_a > 5) { Ci += 1; return; }
    Ci += 100;
  }
}
