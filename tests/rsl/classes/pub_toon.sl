class toon(uniform float bands = 3; uniform color palette[3] = {color(1,0,0), color(0,1,0), color(0,0,1)}; float outline = .3)
{
   public varying float m_edge = 0;
   varying normal Nn = 0;
   public void begin() {
      extern vector I; extern normal N;
      Nn = normalize(N);
      m_edge = (abs(Nn.normalize(I)) < outline) ? 1 : 0;
   }
   public void opacity(output varying color Oi) { Oi = 1; }
   public void lighting(output varying color Ci, Oi) {
      float level = 0;
      shader lts[] = getlights();
      uniform float i, n = arraylength(lts);
      for (i = 0; i < n; i += 1) {
         vector l = 0; color cl = 0;
         lts[i]->light(l, cl);
         level += max(0, Nn . normalize(-l)) * comp(cl, 0);
      }
      float idx = min(bands - 1, floor(level * bands));
      Ci = palette[idx] * (1 - m_edge);
   }
}
