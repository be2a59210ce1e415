class displace_only(float Km = .5; shader heights[] = {}; string mode = "add";)
{
  public void displacement(output point P; output normal N)
  {
    varying float h = 0; uniform float i;
    for (i = 0; i < arraylength(heights); i += 1) {
      varying point q = P; varying normal m = N;
      if (heights[i] != null) { heights[i]->displacement(q, m); h += distance(q, P); }
    }
    P += Km * h * normalize(N);
    N = calculatenormal(P);
  }
}
