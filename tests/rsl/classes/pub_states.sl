class states(uniform float n = 4) {
  uniform float table[];
  constant float squares[5] = {0, 1, 4, 9, 16};
  uniform string log = "";
  private varying float state = 0;
  public float total = 0;
  void step(float x) { state += x; total = state * 2; }
  public void construct() {
    uniform float i;
    resize(table, n);
    for (i = 0; i < n; i += 1) table[i] = i * i;
    log = concat("n=", format("%d", n));
  }
  public void begin() { state = 1; }
  public void surface(output color Ci, Oi) {
    uniform float i;
    for (i = 0; i < arraylength(table); i += 1) step(table[i] * s);
    Ci = color(state, total, squares[n]);
    Oi = log == "n=4" ? 1 : 0.5;
  }
}
