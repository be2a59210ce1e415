// A plaster wall: paint over plaster over brick, by masks of noise.
#include <stdrsl/ShadingContext.h>
#include <stdrsl/Fresnel.h>
#pragma annotation "grouping" "Paint/paintColor;"
#pragma annotation paintColor "gadgettype=colorslider;label=Paint;"

class layered_plaster(
    color paintColor = color(0.55, 0.7, 0.62);
    color plasterColor = color(0.8, 0.76, 0.7);
    color brickColor = color(0.5, 0.2, 0.14);
    float wear = 0.45, scale = 3, Kd = 0.9, Ks = 0.15, roughness = 0.25;
    uniform float __computesOpacity = 0;
    )
{
    stdrsl_ShadingContext m_shadingCtx;
    varying float m_paint = 1;
    varying float m_plaster = 1;
    varying color m_diffuse = 0;
    constant float m_scale2 = scale * 2.3;

    public void construct()
    {
        m_shadingCtx->construct();
    }
    public void begin()
    {
        m_shadingCtx->init();
    }
    float layer(point p; float size; float cover)
    {
        float n = noise(p * size) * 0.6 + noise(p * size * 2.7) * 0.3 + noise(p * size * 6.1) * 0.1;
        return smoothstep(cover - 0.05, cover + 0.05, n);
    }
    public void displacement(output point P; output normal N)
    {
        point Pobj = transform("object", P);
        m_paint = layer(Pobj, scale, wear);
        m_plaster = layer(Pobj + 7, m_scale2, wear * 0.7);
        m_shadingCtx->displace(m_shadingCtx->m_Nn, 0.01 * m_paint + 0.03 * m_plaster, "bump");
    }
    public void prelighting(output color Ci, Oi)
    {
        m_diffuse = mix(brickColor, mix(plasterColor, paintColor, m_paint), m_plaster);
        Oi = Os;
    }
    public void lighting(output color Ci, Oi)
    {
        color spec = specular(m_shadingCtx->m_Ns, m_shadingCtx->m_Vn, roughness);
        Ci = Oi * (m_diffuse * (ambient() + Kd * diffuse(m_shadingCtx->m_Ns)) + Ks * m_paint * spec);
    }
}
