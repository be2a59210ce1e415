#include <stdrsl/ShadingContext.h>
class relight_pieces(color Kd_color = color(0.7, 0.7, 0.5); float Kd = 0.9, Ks = 0.3; float rough = 0.15; output varying color diffuse_direct = 0; output varying color specular_direct = 0)
{
    stdrsl_ShadingContext ctx;
    varying color m_tex = 0;
    varying float m_occ = 1;
    public void begin() { ctx->init(); }
    public void prelighting(output color Ci, Oi)
    {
        m_tex = Kd_color * mix(0.8, 1, float noise(s * 20, t * 20));
        m_occ = 1 - 0.5 * occlusion(P, ctx->m_Ns, 8);
        Oi = Os;
    }
    public void diffuselighting(output color Ci, Oi)
    {
        diffuse_direct = m_tex * Kd * m_occ * diffuse(ctx->m_Ns);
        Ci += diffuse_direct;
    }
    public void specularlighting(output color Ci, Oi)
    {
        specular_direct = Ks * specular(ctx->m_Ns, ctx->m_Vn, rough);
        Ci += specular_direct;
    }
    public void postlighting(output color Ci, Oi) { Ci *= Oi; }
}
