surface use_old(shader colorInput = null; string floatInput = "pn"; float Kd = 1;)
{
  color base = Cs; float f = 0;
  if (colorInput != null) base = colorInput->resultRGB;
  shader fl = getshader(floatInput);
  if (fl != null) f = fl->result;
  Oi = Os;
  Ci = Oi * base * Kd + f;
}
