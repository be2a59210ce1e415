// The first listing of ../shared/seeds/004, completed: a pierced shell of coral.
#include <stdrsl/ShadingContext.h>
class rslTwoShader(float scale = 5, depth = 0.12, holes = 0.55; color shell = color(0.95, 0.55, 0.4);
                   color inside = color(0.45, 0.08, 0.12);) {
    float classVar;
    stdrsl_ShadingContext m_shadingCtx;
    color m_base = 0;
    public void construct() {
        m_shadingCtx->construct();
    }
    public void begin() {
        m_shadingCtx->init(); //initialize data struct
        point Q = scale * transform("object", P);
        classVar = 0.65 * float noise(Q) + 0.35 * float noise(2.1 * Q + 7);
    }
    public void displacement() {
        //Runs first, modifies P and the normal
        m_shadingCtx->displace(normalize(vector N), depth * smoothstep(0.3, 0.7, classVar), "displace");
    }
    public void opacity() { //optional
        //Runs next, gives opportunity to exit before shading
        Oi = Os * (1 - smoothstep(holes, holes + 0.02, classVar));
    }
    public void prelighting() { //optional
        //Precompute any non-light-specific values for lighting
        m_base = mix(inside, shell, smoothstep(0.25, holes, classVar));
        userCreatedFunc();
    }
    public void lighting() {
        //Light-position dependent step, run per light
        normal Nf = faceforward(m_shadingCtx->m_Nn, I);
        Ci += m_base * (ambient() + diffuse(Nf)) + 0.35 * specular(Nf, m_shadingCtx->m_Vn, 0.12);
    }
    public void postlighting() { //optional
        //Any post-processing required
        Ci *= Oi;
    }
    public void userCreatedFunc() {
        m_base *= 0.75 + 0.5 * cellnoise(30 * transform("object", P));
    }
}
