// class: the customary example of shader objects, with stdrsl's ShadingContext and all methods
#include <stdrsl/ShadingContext.h>
#pragma annotation amount "gadgettype=floatslider;min=0;max=1"
class rslTwoShader(float Kd = 0.8, cut = 0.2;
#pragma annotation base "gadgettype=colorslider"
                   color base = color(0.3, 0.5, 0.2); float amount = 0.05;) {
    varying float classVar = 0;
    stdrsl_ShadingContext m_shadingCtx;

    public void construct() { m_shadingCtx->construct(); }
    public void begin() {
        m_shadingCtx->init();
        classVar = userCreatedFunc(s);
    }
    public void displacement(output point P; output normal N) {
        m_shadingCtx->displace(vector m_shadingCtx->m_Nn, amount * classVar, "displace");
    }
    public void opacity(output color Oi) { Oi = step(cut, classVar) * Os; }
    public void prelighting(output color Ci, Oi) { Ci = base * Cs * classVar; }
    public void lighting(output color Ci, Oi) {
        color lit = 0;
        illuminance(P, m_shadingCtx->m_Ns, PI / 2) {
            lit += Cl * max(0, normalize(L) . m_shadingCtx->m_Ns);
        }
        Ci *= Kd * lit + 0.1;
    }
    public void postlighting(output color Ci, Oi) { Ci *= Oi; }
    public float userCreatedFunc(float x) { return 0.5 + 0.5 * sin(x * 20); }
};
