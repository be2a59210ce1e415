// prman_samples.h: PRMan's functions that make and evaluate radiance samples. A source that calls
// one of them has it without an #include.
#ifndef KINORA_PRMAN_SAMPLES_H
#define KINORA_PRMAN_SAMPLES_H

#include <stdrsl/specularas.h>

// A lobe of Ashikhmin and Shirley with these exponents along T and across it; V to the viewer.
void kinora_lobe_as(output stdrsl_SpecularAS lobe; output stdrsl_ShadingContext ctx;
                    color specular; float eu; float ev; normal N; vector T; vector V;) {
    lobe->m_specColor = specular;
    lobe->m_roughValueU = inversesqrt(max(eu, 1e-6));
    lobe->m_roughValueV = inversesqrt(max(ev, 1e-6));
    ctx->m_Ns = normalize(N);
    ctx->m_Vn = normalize(V);
    ctx->setTangents(T);
}

// Appends samples of the lobe.
void generateSamplesAS(color specular; float count; float eu; float ev; normal N; vector T;
                       vector V; output __radiancesample samples[]) {
    stdrsl_SpecularAS lobe;
    stdrsl_ShadingContext ctx;
    stdrsl_Fresnel fres;
    kinora_lobe_as(lobe, ctx, specular, eu, ev, N, T, V);
    lobe->m_sampleCount = count;
    lobe->genSpecularSamps(ctx, fres, "specular", samples);
}
void evaluateSamplesAS(color specular; float eu; float ev; normal N; vector T; vector V;
                       output __radiancesample samples[]) {
    stdrsl_SpecularAS lobe;
    stdrsl_ShadingContext ctx;
    stdrsl_Fresnel fres;
    kinora_lobe_as(lobe, ctx, specular, eu, ev, N, T, V);
    lobe->evalSpecularSamps(ctx, fres, samples);
}

// The light of an environment map that lies in the space, by the cosine to N: what a sample of the
// direction has. The last two are the pairs "environmentspace" and "scale".
void evaluateSamplesEnv(string map; point P; normal N; output __radiancesample samples[];
                        string space = "world"; color scale = 1;) {
    normal Nn = normalize(N);
    float i;
    for (i = 0; i < arraylength(samples); i += 1) {
        vector towards = samples[i]->direction;
        samples[i]->radiance = scale * color environment(map, vtransform(space, towards));
        samples[i]->lightPdf = max(0, towards . Nn) * M_INVPI;
    }
}
// Makes `count` samples of it.
void generateSamplesEnv(string map; point P; normal N; float count;
                        output __radiancesample samples[]; string space = "world";
                        color scale = 1;) {
    normal Nn = normalize(N);
    vector across = abs(Nn[0]) < 0.5 ? vector "current" (1, 0, 0) : vector "current" (0, 1, 0);
    vector X = normalize(across ^ Nn), Y = Nn ^ X;
    float i;
    resize(samples, count);
    for (i = 0; i < count; i += 1) {
        float angle = random() * M_TWOPI, square = (i + random()) / count;
        samples[i]->direction = X * (sqrt(square) * cos(angle)) + Y * (sqrt(square) * sin(angle)) +
                                Nn * sqrt(1 - square);
        samples[i]->distance = M_MAXDIST;
    }
    evaluateSamplesEnv(map, P, Nn, samples, space, scale);
}

#endif
