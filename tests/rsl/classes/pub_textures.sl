class textures(string map = ""; float blur = 0; uniform float usemap = 1;
  output varying color tex = 0; string ptex = "")
{
  filterregion m_fr;
  public void begin() {
    m_fr->calculate2d(s, t);
    m_fr->blur(blur); m_fr->scale(1, 1);
    float xres[2] = {0,0}; float ex = 0;
    if (map != "") {
      if (textureinfo(map, "exists", ex) == 1 && ex == 1)
        textureinfo(map, "resolution", xres);
    }
  }
  public void surface(output color Ci, Oi) {
    tex = 0.5;
    if (map != "" && usemap > 0) {
      tex = color texture(map, m_fr);
      tex += color texture(map, s, t, "filter", "gaussian", "swidth", 1, "twidth", 1, "lerp", 1);
      float al = texture(map[3], s, t, "fill", 1);
      tex *= al;
    }
    if (ptex != "") tex = ptexture(ptex, 0, 3, m_fr);
    Ci = tex; Oi = 1;
  }
}
