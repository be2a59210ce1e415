class rays(uniform float samples = 16; float maxdist = 1000; string traceset = "all"; float blurangle = 5;) {
  varying float m_hits = 0;
  public void surface(output color Ci, Oi) {
    normal Nn = normalize(N); vector R = reflect(normalize(I), Nn);
    color hit = 0, accum = 0; float dist = 0; vector dir = 0; point hp = 0;
    gather("illuminance", P, R, radians(blurangle), samples, "samplebase", 0.5, "bias", 0.01,
           "maxdist", maxdist, "subset", traceset, "label", "reflect", "distribution", "cosine",
           "surface:Ci", hit, "ray:length", dist, "ray:direction", dir, "primitive:P", hp)
      { accum += hit; m_hits += 1; }
    else
      { accum += color(.1,.2,.3); }
    if (samples > 0) accum /= samples;
    color tr = transmission(P, P + Nn * 10, "samples", 4, "samplecone", 0, "bias", 0.01);
    color sh = shadow("raytrace", P, "samples", 1);
    float occ = occlusion(P, Nn, samples, "maxdist", maxdist, "coneangle", PI/2, "hitsides", "both");
    Ci = accum + tr * (1 - occ);
    Oi = 1;
    if (isshadowray() == 1) Ci = 0;
    string typ = ""; uniform float dep = 0; string lab = "";
    rayinfo("type", typ); rayinfo("depth", dep); rayinfo("label", lab);
  }
}
