// rings by mod, grain by noise, smoothstep edges
#define snoise(x) (2*noise(x)-1)
#define boxstep(a,b,x) (clamp(((x)-(a))/((b)-(a)),0,1))
surface
style_1990s_wood ( float Ka = 1, Kd = .75, Ks = .4, roughness = .1;
         color specularcolor = 1;
         float ringscale = 15, txtscale = 1;
         color lightwood = color (0.69, 0.44, 0.25);
         color darkwood  = color (0.35, 0.22, 0.08);
         float grainy = 1; )
{
  point PP; point V, Nf;
  float y, z, r, r2, my_t;
  color Ct;

  PP = txtscale * transform ("shader", P);
  PP += noise (PP);
  y = ycomp(PP);  z = zcomp(PP);
  r = sqrt (y*y + z*z);
  r *= ringscale;
  r += abs (noise(r));
  r -= floor (r);
  r = smoothstep (0, 0.8, r) - smoothstep (0.83, 1.0, r);
  Ct = mix (lightwood, darkwood, r);
  setxcomp (PP, xcomp(PP)*8); setycomp (PP, ycomp(PP)*20); setzcomp (PP, zcomp(PP)*20);
  my_t = zcomp (PP) / ringscale;
  if (grainy > 0) {
      PP *= 32; r2 = snoise (PP); Ct *= 0.95 + 0.05 * boxstep(0.2, 0.6, r2);
  }
  Nf = faceforward (normalize(N),I);
  V = -normalize (I);
  Oi = Os;
  Ci = Os * (Ct * (Ka*ambient() + Kd*diffuse(Nf)) +
             specularcolor * (Ks * specular(Nf, V, roughness))) + my_t*0;
}
