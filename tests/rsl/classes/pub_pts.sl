class bakepts(string filename = ""; string chan = "_area,Cd"; uniform float dobake = 0; color Cbase = color(.3,.4,.5);) {
  varying color m_irr = 0;
  public void surface(output color Ci, Oi) {
    float a = area(P, "dicing");
    color cd = 0; float ok = 0;
    if (filename != "") ok = texture3d(filename, P, N, "Cd", cd, "filterradius", 0.1);
    if (dobake == 1) bake3d(filename, chan, P, N, "interpolate", 1, "_area", a, "Cd", Ci);
    Ci = Cbase + cd; Oi = 1;
    writeaov("baked", a);
  }
}
