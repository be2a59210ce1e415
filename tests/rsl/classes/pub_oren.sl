#include <stdrsl/OrenNayar.h>
#include <stdrsl/SpecularBlinn.h>
#include <stdrsl/SpecularDBRDF.h>
class oren(color diffuseColor = color(.5); float sigma = .4; float rough = 0.2;) {
  stdrsl_ShadingContext m_ctx; stdrsl_Fresnel m_f; stdrsl_OrenNayar m_d; stdrsl_SpecularBlinn m_s; stdrsl_SpecularDBRDF m_db;
  public void construct() { m_ctx->construct(); }
  public void begin() { m_ctx->init(); m_f->initSchlick(m_ctx, 1, 0, 0.04); }
  public void prelighting(output color Ci, Oi) {
    m_d->init(m_ctx, diffuseColor, sigma, 1, 16);
    m_s->init(m_ctx, "beckmann", color m_f->m_Kr, rough, 1, 16);
    m_db->init(m_ctx, "beckmann", color m_f->m_Kr, rough, 1, 16);
  }
  public void evaluateSamples(string d; output __radiancesample s[]) {
    if (d == "diffuse") m_d->evalDiffuseSamps(m_ctx, m_f, s);
    else if (d == "specular" || d == "indirectspecular") {
      stdrsl_RadianceSample u; float counts[2];
      m_s->evalSpecularSamps(m_ctx, m_f, s); u->accumulateMaterialResponse(s);
      m_db->evalSpecularSamps(m_ctx, m_f, s); u->accumulateMaterialResponse(s);
    }
  }
  public void generateSamples(string d; output __radiancesample s[]) {
    if (d == "specular") { float st = arraylength(s); m_s->genSpecularSamps(m_ctx, m_f, d, s);
       float counts[]; push(counts, arraylength(s) - st);
       stdrsl_RadianceSample u; u->normalizeMaterialResponse(s, counts); }
  }
  public void lighting(output color Ci, Oi) { Ci = directlighting(this, getlights(), "mis", 1, "diffusemis", 0); Ci *= Oi; }
}
