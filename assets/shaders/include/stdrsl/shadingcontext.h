// stdrsl/ShadingContext.h: what most materials ask of a point.
#ifndef STDRSL_SHADINGCONTEXT_H
#define STDRSL_SHADINGCONTEXT_H

#include <stdrsl/math.h>
#include <stdrsl/samplemgr.h>

struct stdrsl_ShadingUtils {
    // Directions of length 1: the normal, the ray's, the normal turned to the viewer, and the one
    // to shade with, which is turned on surfaces of two sides and behind a first hit.
    void GetShadingVars(float depth; float sides; output normal Nn; output vector In;
                        output normal Nf; output normal Ns;) {
        extern normal N;
        extern vector I;
        Nn = normalize(N);
        In = normalize(I);
        Nf = faceforward(Nn, In, Nn);
        Ns = (sides == 2 || depth > 0) ? Nf : Nn;
    }
};

struct stdrsl_ShadingContext {
    varying point m_P = 0;
    varying normal m_Nn = 0;      // N of length 1
    varying normal m_Ns = 0;      // turned to the viewer
    varying normal m_OrigNn = 0;  // before displace()
    varying vector m_I = 0;
    varying vector m_In = 0;      // I of length 1
    varying vector m_Vn = 0;      // to the viewer
    varying vector m_Tangent = 0;
    varying vector m_Bitangent = 0;
    varying float m_EnteringRegion = 1;
    uniform float m_RayDepth = 0;  // rayinfo's answers count as uniform
    uniform float m_DiffuseDepth = 0;
    uniform float m_depth = 0;
    uniform float m_Sides = 2;
    stdrsl_SampleMgr m_SampleMgr;
    stdrsl_ShadingUtils m_ShadingUtils;

    void construct() { attribute("Sides", m_Sides); }

    void initDepths() {
        rayinfo("depth", m_RayDepth);
        rayinfo("diffusedepth", m_DiffuseDepth);
        m_depth = m_RayDepth;
    }
    // The normal has changed.
    void reinit() {
        extern point P;
        extern normal N;
        extern vector I;
        normal forward = 0;
        m_P = P;
        m_I = I;
        m_ShadingUtils->GetShadingVars(m_RayDepth, m_Sides, m_Nn, m_In, forward, m_Ns);
        m_Vn = -m_In;
        m_EnteringRegion = (m_In . m_Nn) < 0;
    }
    void setTangents(vector along) {
        vector across = normalize(m_Ns ^ along);
        m_Bitangent = across;
        m_Tangent = normalize(across ^ m_Ns);
    }
    void init() {
        extern normal N;
        extern vector dPdu;
        initDepths();
        m_OrigNn = normalize(N);
        reinit();
        setTangents(dPdu);
    }
    // The tangent turned about the normal, by turns.
    void initWithTangentField(float turns) {
        init();
        float angle = turns * M_TWOPI;
        setTangents(m_Tangent * cos(angle) + m_Bitangent * sin(angle));
    }
    // Curves: the tangent lies along them (v), and the normal faces the viewer.
    void initHair(float unused) {
        extern vector dPdv;
        init();
        m_Tangent = normalize(dPdv);
        m_Bitangent = normalize(m_Vn ^ m_Tangent);
        m_Ns = normal normalize(m_Tangent ^ m_Bitangent);
        m_Nn = m_Ns;
    }
    // Moves P along a direction, or with "bump" only the normal.
    void displace(vector direction; float amount; string mode) {
        extern point P;
        extern normal N;
        point moved = P + direction * amount;
        normal bent = normalize(calculatenormal(moved));
        if (mode != "bump") P = moved;
        N = bent;
        reinit();
    }
};

#include <stdrsl/fresnel.h>

#endif
