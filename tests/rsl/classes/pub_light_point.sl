class pointlight(uniform float intensity = 1; uniform color lightcolor = 1; uniform float decay = 2;
  uniform string shadowname = ""; uniform string __category = "point"; output uniform float __nonspecular = 0;
  output varying color __shadowC = 0;)
{
  constant point m_from = point "shader" (0,0,0);
  uniform color m_col = 0;
  public void construct() { m_col = intensity * lightcolor; }
  public void light(output vector L; output color Cl) {
    illuminate(m_from) {
      float d = length(L);
      Cl = m_col / pow(d, decay);
      if (shadowname != "") { __shadowC = shadow(shadowname, Ps); Cl *= 1 - __shadowC; }
    }
  }
}
