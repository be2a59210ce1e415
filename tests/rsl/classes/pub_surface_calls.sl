class blend2(shader a = null, b = null; float mixer = .5; uniform float usesurface = 1) {
  public void displacement(output point P; output normal N) {
    if (a != null && hasmethod(a, "displacement")) a->displacement(P, N);
  }
  public void opacity(output color Oi) {
    color oa = Os, ob = Os;
    if (hasmethod(a, "opacity")) a->opacity(oa);
    if (hasmethod(b, "opacity")) b->opacity(ob);
    Oi = mix(oa, ob, mixer);
  }
  public void surface(output color Ci, Oi) {
    color ca = 0, oa = 1, cb = 0, ob = 1;
    a->surface(ca, oa);
    b->surface(cb, ob);
    Ci = mix(ca, cb, mixer); Oi = mix(oa, ob, mixer);
  }
}
