#include <stdrsl/ShadingContext.h>
#include <stdrsl/SampleMgr.h>
class depth_sample_mgr(uniform float diffuseSamples = 64, specularSamples = 16; float maxvar = 0.02; color albedo = 0.6)
{
    stdrsl_ShadingContext m_shadingCtx;
    uniform float m_nspec = 1;
    varying float m_ndiff = 1, m_var = 0.02;
    public void construct() { m_shadingCtx->construct(); }
    public void begin()
    {
        m_shadingCtx->init();
        m_shadingCtx->m_SampleMgr->computeIndirectDiffuseSamples(diffuseSamples, maxvar, m_ndiff, m_var);
        varying float n = 1;
        m_shadingCtx->m_SampleMgr->computeDepthBasedSampleReduction(m_shadingCtx->m_RayDepth, specularSamples, 1, 1, n);
        m_nspec = gridmax(n);
    }
    public void surface(output color Ci, Oi)
    {
        color ind = indirectdiffuse(P, m_shadingCtx->m_Ns, m_ndiff, "maxvariation", m_var);
        Oi = Os;
        Ci = Oi * albedo * (diffuse(m_shadingCtx->m_Ns) + ind) + 0.02 * m_nspec;
    }
}
