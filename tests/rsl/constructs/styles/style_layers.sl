// layers of comments, macros for repeated layers, blended by opacity
#define blend(a,b,x) ((a) * (1 - (x)) + (b) * (x))
#define intersection(a,b) ((a) * (b))
#define union(a,b) ((a) + (b) - (a) * (b))
#define pulse(a,b,fuzz,x) (smoothstep((a)-(fuzz),(a),(x)) - smoothstep((b)-(fuzz),(b),(x)))
#define repeat(x,freq) (mod((x) * (freq), 1.0))
#define whichtile(x,freq) (floor((x) * (freq)))
#define odd(x) (mod((x), 2) == 1)
#define even(x) (mod((x), 2) == 0)
#define LAYER(c, o) surface_color = blend(surface_color, c, o); surface_opac = union(surface_opac, color(o, o, o));
surface style_layers() {
  color surface_color, layer_color; color surface_opac, layer_opac;
  float ss, tt, fuzz = 0.02; uniform float freq = 4;
  /* background layer */ surface_color = Cs; surface_opac = Os;
  /* layer 1 - stripes */
  ss = repeat(s, freq); tt = repeat(t, freq);
  layer_color = color (0.1, 0.5, 0.1);
  layer_opac = pulse(0.35, 0.65, fuzz, ss) * (even(whichtile(t, freq)) ? 1 : 0.5);
  surface_color = blend(surface_color, layer_color, layer_opac);
  /* layer 2 */ LAYER(color "rgb" (0.8,0.2,0.2), intersection(pulse(0.2,0.8,fuzz,ss), pulse(0.2,0.8,fuzz,tt)))
  Oi = surface_opac; Ci = surface_opac * surface_color;
}
