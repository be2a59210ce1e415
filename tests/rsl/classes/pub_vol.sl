#include <stdrsl/IsotropicVolume.h>
class smoke(float density = .5; color albedo = color(.8); float stepsize = .25;) {
  stdrsl_ShadingContext ctx; stdrsl_IsotropicVolume iso; stdrsl_Fresnel f;
  public void construct() { ctx->construct(); }
  public void begin() { ctx->init(); iso->init(albedo); }
  public void evaluateSamples(string d; output __radiancesample s[]) {
    if (d == "diffuse") iso->evalDiffuseSamps(ctx, f, s);
  }
  public void opacity(output color Oi) { Oi = clamp(density * (1 + 0 * noise(P)), 0, 1); }
  public void lighting(output color Ci, Oi) {
    Ci = Oi * directlighting(this, getlights(), "integrationdomain", "sphere");
  }
}
