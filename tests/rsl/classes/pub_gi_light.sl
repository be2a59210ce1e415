class envlight(
   string envmap = "", envspace = "world"; color tint = 1; float gain = 1;
   uniform float samples = 64; string __category = "indirect,environment";)
{
   shader m_self = null;
   public void construct() { m_self = this; }
   public void light(output vector L; output color Cl) {
      L = 0; Cl = 0;
      illuminate(Ps + Ns) {   /* force execution independent of light location */
         normal shadingnormal = normalize(Ns);
         float occ = occlusion(Ps, shadingnormal, samples, "maxdist", 10);
         vector dir = vtransform(envspace, shadingnormal);
         color env = gain * tint;
         if (envmap != "") env *= color environment(envmap, dir);
         L = -shadingnormal;
         Cl = env * (1 - occ);
      }
   }
}
