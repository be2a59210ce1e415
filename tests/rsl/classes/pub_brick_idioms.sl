// Plain surface with RSL 2.0 arrays and structs inside it
struct Ramp {
  uniform float knots[];
  uniform color colors[];
  void add(uniform float k; uniform color c) { push(knots, k); push(colors, c); }
  color eval(float x) {
    uniform float n = arraylength(knots), i;
    color c = colors[0];
    for (i = 1; i < n; i += 1) {
      float w = clamp((x - knots[i-1]) / (knots[i] - knots[i-1]), 0, 1);
      c = mix(c, colors[i], w);
    }
    return c;
  }
}
surface brick_idioms(uniform float ks[] = {0, 0.5, 1}; uniform color cs[] = {color(0,0,0), color(1,0,0), color(1,1,0)};
   output varying float count = 0)
{
  Ramp r;
  uniform float i;
  for (i = 0; i < arraylength(ks); i += 1) r->add(ks[i], cs[i]);
  float inside = s > 0.25;
  string names[] = {"a", "b"};
  push(names, "c");
  count = arraylength(names) + inside;
  Ci = r->eval(s);
  Oi = 1;
}
