class variations(float seed = 1; uniform string chans[] = {"r", "g"}; color base[] = {color(1,0,0), color(0,1,0), color(0,0,1)};) {
  uniform float m_idx[]; varying float m_rand = 0;
  public void construct() { uniform float i; for (i = 0; i < 3; i += 1) push(m_idx, 2 - i); }
  public void begin() { m_rand = cellnoise(floor(s * 10) + seed); }
  public color at(float i) { return base[m_idx[i]]; }
  public void surface(output color Ci, Oi) {
    float k = floor(s * 3);
    Ci = at(k);
    uniform float q = pop(m_idx);
    Oi = color(q, arraylength(m_idx), capacity(m_idx) >= 2);
    if (base == base) Oi[1] = 9;
  }
}
