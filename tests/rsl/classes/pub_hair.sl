#include <stdrsl/Hair.h>
class hair(color root = color(.1,.05,0), tip = color(.6,.4,.2); float specwidth = 10, shift = 2;) {
  stdrsl_ShadingContext m_ctx;
  stdrsl_Hair m_diff, m_spec1, m_spec2;
  public void construct() { m_ctx->construct(); }
  public void begin() { m_ctx->initHair(0); }
  public void prelighting(output color Ci, Oi) {
    m_diff->initDiffuse(m_ctx, .8, color 1, color .5, root, tip);
    m_spec1->initSpecular(m_ctx, 4, 0, shift, specwidth, color 1, 1.55);
  }
  public void lighting(output color Ci, Oi) {
    Ci = directlighting(this, getlights(), "integrationdomain", "sphere");
    Ci *= Oi;
  }
  public void evaluateSamples(string d; output __radiancesample samps[]) {
    if (d == "diffuse") m_diff->evalDiffuseSamps(m_ctx, samps);
    else m_spec1->evalSpecularSamps(m_ctx, samps);
  }
}
