#include <stdrsl/ShadingContext.h>
#include <stdrsl/Fresnel.h>
class glass_class(color transmission_tint = color(0.95, 1, 0.97); float ior = 1.5; float Kr = 1, Kt = 1; uniform float maxdepth = 4; )
{
    stdrsl_ShadingContext m_ctx;
    stdrsl_Fresnel m_fresnel;
    public void construct() { m_ctx->construct(); option("trace:maxdepth", maxdepth); }
    public void begin() { m_ctx->init(); m_fresnel->init(m_ctx, 1.0, ior); }
    public void opacity(output color Oi) { Oi = 1 - transmission_tint * m_fresnel->m_Kt; }
    public void surface(output color Ci, Oi)
    {
        color refl = 0, refr = 0;
        if (m_ctx->m_RayDepth < maxdepth) {
            if (m_fresnel->m_Kr > 0.001) refl = trace(P, m_fresnel->m_Rv);
            if (m_fresnel->m_Kt > 0.001) refr = trace(P, m_fresnel->m_Tv);
        }
        Ci = Kr * m_fresnel->m_Kr * refl + Kt * m_fresnel->m_Kt * refr * transmission_tint;
        Oi = 1;
    }
}
