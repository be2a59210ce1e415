class getvars(uniform string target = "other"; varying float primvarA = 1; color userColor = color(0.5)) {
  public void surface(output color Ci, Oi) {
    shader s0 = getshader(target);
    float g = -1; color c = 0; string nm = "none"; float arr[3] = {0,0,0};
    uniform float ok = getvar(s0, "gain", g);
    ok += getvar(s0, "tint", c);
    ok += getvar(s0, "label", nm);
    ok += getvar(s0, "list", arr);
    ok += getvar(s0, "missing", g);
    float pv = 0; 
    getvar(null, "primvarA", pv);
    Ci = color(ok, g, arr[2]) + c;
    Oi = color(nm == "hello", pv, 0);
  }
}
