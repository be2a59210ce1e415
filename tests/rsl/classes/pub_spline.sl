class spline_ramp(
   uniform float positions[] = {0, 0, .5, 1, 1};
   uniform color values[] = {color(0), color(0), color(.5,0,0), color 1, color 1};
   uniform string basis = "linear"; float gamma[2] = {1, 2})
{
   color lookup(float x) {
     return spline(basis, x, values);
   }
   public void surface(output color Ci, Oi) {
     Ci = spline(basis, s, values);
     float g = gamma[1];
     Oi = color(g, arraylength(values), arraylength(positions));
   }
}
