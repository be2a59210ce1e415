#include <stdrsl/ShadingContext.h>
class glass(float eta = 1.5; color tint = 1; uniform float maxdepth = 3; uniform float __computesOpacity = 0;) {
  stdrsl_ShadingContext ctx;
  stdrsl_Fresnel fr;
  public void construct() { ctx->construct(); }
  public void begin() { ctx->init(); fr->init(ctx, 1, eta); }
  public void opacity(output color Oi) { Oi = 1 - tint; }
  public void surface(output color Ci, Oi) {
    uniform float depth = 0; string type = "";
    rayinfo("depth", depth); rayinfo("type", type);
    color refl = 0, refr = 0;
    if (depth < maxdepth && type != "transmission") {
      refl = trace(P, fr->m_Rv);
      if (fr->m_Kt > 0) refr = trace(P, fr->m_Tv);
    }
    Ci = fr->m_Kr * refl + fr->m_Kt * refr * tint;
    Ci += fr->m_Kr;
    Oi = 1;
  }
}
