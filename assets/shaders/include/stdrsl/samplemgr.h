// stdrsl/SampleMgr.h: how many samples a ray of some depth is worth.
#ifndef STDRSL_SAMPLEMGR_H
#define STDRSL_SAMPLEMGR_H

struct stdrsl_SampleMgr {
    // A quarter at each depth, but at least the minimum.
    void computeDepthBasedSampleReduction(float depth; float samples; float minimum; float enabled;
                                          output float reduced;) {
        reduced = samples;
        if (enabled != 0) reduced = max(minimum, floor(samples / pow(4, depth)));
    }
    // Behind a first bounce a few samples of more tolerance do.
    void computeIndirectDiffuseSamples(float samples; float variation; output float reduced;
                                       output float tolerance;) {
        float bounces = 0;
        rayinfo("diffusedepth", bounces);
        reduced = max(1, floor(samples / pow(4, bounces)));
        tolerance = variation * (1 + bounces);
    }
};

struct stdrsl_SampleMgrPathTrace {
    uniform float m_depth = 0;
    void construct() {}
    void begin() { rayinfo("depth", m_depth); }
    void computeLightSamples(float minimum; float maximum; output float samples;) {
        samples = m_depth > 0 ? minimum : maximum;
    }
};

// Callers rely on each header to bring these.
#ifndef STDRSL_SHADINGCONTEXT_H
#include <stdrsl/fresnel.h>
#endif

#endif
