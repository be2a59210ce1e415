// integrators.h: light of a class by methods evaluateSamples() and generateSamples(), its own or
// those of another shader. A source that calls directlighting() or indirectspecular() has it without
// an #include; these functions become methods of its class.
//
// E. Veach and L. Guibas 1995: a direction that both a light and the material may choose is weighed
// by how dense the samples of each are about it. Cl of a record is radiance / (PI x density), so
// that a Lambert surface gives the same by diffuse() and by directlighting(). An old light of Cl is
// one direction that no material chooses: its weight is 1.
#ifndef KINORA_INTEGRATORS_H
#define KINORA_INTEGRATORS_H

#include <stdrsl/radiancesample.h>

float integrate_listed(shader list[]; shader one;) {
    float i;
    for (i = 0; i < arraylength(list); i += 1)
        if (list[i] == one) return 1;
    return 0;
}

// Of a sample whose own kind is `own` dense about it, and the other kind `other`.
float integrate_weight(float own; float other; float power;) {
    if (own <= 0) return 0;
    float share = other / own;
    return 1 / (1 + (power == 1 ? share : share * share));
}

// The material's samples of a lobe, unless some are there.
void integrate_choose(string what; float wanted; output __radiancesample samples[];) {
    if (wanted != 0 && arraylength(samples) == 0) generateSamples(what, samples);
}
void integrate_choose_of(shader which; string what; float wanted;
                         output __radiancesample samples[];) {
    if (wanted != 0 && arraylength(samples) == 0 && hasmethod(which, "generateSamples") == 1)
        which->generateSamples(what, samples);
}

// Results of light groups, none yet. An array of fixed length has as many as fit.
float integrate_clear(output color sums[]; string groups[];) {
    float k;
    for (k = 0; k < min(arraylength(groups), arraylength(sums)); k += 1) sums[k] = 0;
    return 0;
}
float integrate_resize(output color sums[]; string groups[];) {
    resize(sums, arraylength(groups));
    return integrate_clear(sums, groups);
}
// The place of a light's group among the wanted ones; -1: it is of none.
float integrate_group(string groups[]; string name;) {
    float k, place = -1;
    for (k = 0; k < arraylength(groups); k += 1)
        if (groups[k] == name) place = k;
    return place;
}

// Adds what a record gives through one lobe, with shadows and without, to the sums and to those of
// its light's group. ARRIVES is what the record's light counts there.
#define KINORA_ADD(RESULT, ARRIVES)                                                            \
    RESULT += ARRIVES * Cl;                                                                    \
    if (bare != 0) bare_##RESULT += ARRIVES * lightbare();                                     \
    if (wants_##RESULT != 0 && group >= 0 && group < arraylength(groups_##RESULT))             \
        groups_##RESULT[group] += ARRIVES * Cl;                                                \
    if (wants_bare_##RESULT != 0 && group >= 0 && group < arraylength(groups_bare_##RESULT))   \
        groups_bare_##RESULT[group] += ARRIVES * lightbare();
#define KINORA_FIND_GROUP                                                                      \
    if (wants_matte + wants_shine + wants_bare_matte + wants_bare_shine != 0) {                \
        string name = "";                                                                      \
        lightsource("__group", name);                                                          \
        group = integrate_group(groups, name);                                                 \
    }

// A light's sample through one lobe: what it adds, weighed against COUNT samples of the material.
// mis: 0 lights alone, 1 both, 2 the material alone. A density below 0: a light without samples.
#define KINORA_LIGHT_SAMPLE(OF, WHAT, COUNT, RESULT)                                           \
    one[0]->reinit();                                                                          \
    one[0]->setLightSample(PI * Cl * max(1e-30, abs(density)), abs(density), towards,          \
                           length(L));                                                         \
    OF evaluateSamples(WHAT, one);                                                             \
    weight = 1;                                                                                \
    if (density >= 0 && COUNT > 0)                                                             \
        weight = mis == 2 ? 0                                                                  \
                          : integrate_weight(density, COUNT * one[0]->materialPdf, power);     \
    response = weight * PI * one[0]->materialResponse;                                         \
    KINORA_ADD(RESULT, response)

// The material's samples through one lobe: each with what lights with sample methods send there.
#define KINORA_MATERIAL_SAMPLES(SAMPLES, COUNT, RESULT, TEST)                                  \
    for (i = 0; i < COUNT; i += 1) {                                                           \
        vector along = SAMPLES[i]->direction;                                                  \
        density = COUNT * SAMPLES[i]->materialPdf;                                             \
        if (density > 0 && along . along > 0) {                                                \
            response = SAMPLES[i]->materialResponse / density;                                 \
            illuminance(category, P, "recordset",                                              \
                        samplinglights(along, density, mis == 2 ? 0 : power)) {                \
                if (TEST) {                                                                    \
                    KINORA_FIND_GROUP                                                          \
                    KINORA_ADD(RESULT, response)                                               \
                }                                                                              \
            }                                                                                  \
        }                                                                                      \
    }

// Samples of each light of the category that passes the test, and the material's: `gloss` and, for
// "diffusemis", `dull`, which are there already. OF: nothing, or the other shader and an arrow.
// bare, wants_..: not 0 where results without shadows, and of light groups, are wanted.
#define KINORA_FORMALS                                                                         \
    color hints; string category; uniform float diffuse_part; uniform float specular_part;     \
    output color diffuseresult; output color specularresult; output color irradianceresult;    \
    output color unshadoweddiffuse; output color unshadowedspecular; uniform float bare;       \
    string groups[]; uniform float wants_matte; output color groups_matte[];                   \
    uniform float wants_shine; output color groups_shine[]; uniform float wants_bare_matte;    \
    output color groups_bare_matte[]; uniform float wants_bare_shine;                          \
    output color groups_bare_shine[]; float mis; float diffusemis; float power;
#define KINORA_ARGUMENTS                                                                       \
    hints, category, diffuse_part, specular_part, diffuseresult, specularresult,               \
        irradianceresult, unshadoweddiffuse, unshadowedspecular, bare, groups, wants_matte,    \
        groups_matte, wants_shine, groups_shine, wants_bare_matte, groups_bare_matte,          \
        wants_bare_shine, groups_bare_shine, mis, diffusemis, power, dull, gloss
#define KINORA_DIRECT(NAME, FORMALS, OF, TEST)                                                 \
    color NAME(FORMALS KINORA_FORMALS output __radiancesample dull[];                          \
               output __radiancesample gloss[];) {                                             \
        color matte = 0, shine = 0, irradiance = 0, bare_matte = 0, bare_shine = 0;            \
        color response = 0;                                                                    \
        float i, weight = 1, density = -1, sampled = 0, group = -1;                            \
        float dulls = mis > 0 && diffuse_part != 0 ? arraylength(dull) : 0;                    \
        float glosses = mis > 0 && specular_part != 0 ? arraylength(gloss) : 0;                \
        __radiancesample one[1];                                                               \
        illuminance(category, P) {                                                             \
            if (TEST) {                                                                        \
                vector towards = normalize(L);                                                 \
                density = lightdensity();                                                      \
                sampled = max(sampled, density < 0 ? 0 : 1);                                   \
                irradiance += Cl * max(0, towards . normalize(N));                             \
                KINORA_FIND_GROUP                                                              \
                if (diffuse_part != 0) {                                                       \
                    KINORA_LIGHT_SAMPLE(OF, "diffuse", dulls, matte)                           \
                }                                                                              \
                if (specular_part != 0) {                                                      \
                    KINORA_LIGHT_SAMPLE(OF, "specular", glosses, shine)                        \
                }                                                                              \
            }                                                                                  \
        }                                                                                      \
        if (sampled > 0) {                                                                     \
            KINORA_MATERIAL_SAMPLES(dull, dulls, matte, TEST)                                  \
            KINORA_MATERIAL_SAMPLES(gloss, glosses, shine, TEST)                               \
        }                                                                                      \
        diffuseresult = matte;                                                                 \
        specularresult = shine;                                                                \
        irradianceresult = irradiance;                                                         \
        unshadoweddiffuse = bare_matte;                                                        \
        unshadowedspecular = bare_shine;                                                       \
        return matte + shine;                                                                  \
    }

// With material samples, with those that the caller keeps, and of a material that has none.
#define KINORA_DIRECT_FORMS(NAME, FORMALS, GIVEN, OF, CHOOSE, TEST)                            \
    KINORA_DIRECT(NAME##_by, FORMALS, OF, TEST)                                                \
    color NAME##_keeping(FORMALS KINORA_FORMALS output __radiancesample gloss[];) {            \
        __radiancesample dull[];                                                               \
        CHOOSE("diffuse", mis * diffusemis * diffuse_part, dull);                              \
        CHOOSE("specular", 1, gloss);                                                          \
        return NAME##_by(GIVEN KINORA_ARGUMENTS);                                              \
    }                                                                                          \
    color NAME(FORMALS KINORA_FORMALS) {                                                       \
        __radiancesample dull[], gloss[];                                                      \
        CHOOSE("diffuse", mis * diffusemis * diffuse_part, dull);                              \
        CHOOSE("specular", mis * specular_part, gloss);                                        \
        return NAME##_by(GIVEN KINORA_ARGUMENTS);                                              \
    }                                                                                          \
    color NAME##_lights(FORMALS KINORA_FORMALS) {                                              \
        __radiancesample dull[], gloss[];                                                      \
        return NAME##_by(GIVEN KINORA_ARGUMENTS);                                              \
    }
#define KINORA_OWN(WHAT, WANTED, SAMPLES) integrate_choose(WHAT, WANTED, SAMPLES)
#define KINORA_OTHER(WHAT, WANTED, SAMPLES) integrate_choose_of(which, WHAT, WANTED, SAMPLES)
#define KINORA_COMMA ,
KINORA_DIRECT_FORMS(integrate_direct, , , , KINORA_OWN, 1 != 0)
KINORA_DIRECT_FORMS(integrate_direct_among, shader among[];, among KINORA_COMMA, , KINORA_OWN,
                    integrate_listed(among, lighthandle()) != 0)
KINORA_DIRECT_FORMS(integrate_direct_of, shader which;, which KINORA_COMMA, which->, KINORA_OTHER,
                    1 != 0)
KINORA_DIRECT_FORMS(integrate_direct_of_among, shader which; shader among[];,
                    which KINORA_COMMA among KINORA_COMMA, which->, KINORA_OTHER,
                    integrate_listed(among, lighthandle()) != 0)
#undef KINORA_OWN
#undef KINORA_OTHER
#undef KINORA_COMMA
#undef KINORA_DIRECT_FORMS
#undef KINORA_ARGUMENTS
#undef KINORA_FORMALS
#undef KINORA_DIRECT
#undef KINORA_MATERIAL_SAMPLES
#undef KINORA_LIGHT_SAMPLE
#undef KINORA_FIND_GROUP
#undef KINORA_ADD

// The mean over the samples of response / pdf x traced light. A pdf or a direction of 0: no ray.
// counted: directlighting() gives the specular light of the lights, so these rays do not see it again.
#define KINORA_INDIRECT(NAME, FORMALS, OF)                                                     \
    color NAME(FORMALS color hints; float maxdist; uniform float counted;                      \
               output __radiancesample materialsamples[];) {                                   \
        if (arraylength(materialsamples) == 0)                                                 \
            OF generateSamples("indirectspecular", materialsamples);                           \
        color sum = 0;                                                                         \
        float i, count = arraylength(materialsamples);                                         \
        for (i = 0; i < count; i += 1) {                                                       \
            vector towards = materialsamples[i]->direction;                                    \
            float pdf = materialsamples[i]->materialPdf;                                       \
            if (pdf > 0 && towards . towards > 0) {                                            \
                color share = materialsamples[i]->materialResponse / (pdf * count);            \
                sum += share * tracesample(towards, maxdist, counted, count,                   \
                                           max(share[0], max(share[1], share[2])));            \
            }                                                                                  \
        }                                                                                      \
        return sum;                                                                            \
    }
KINORA_INDIRECT(integrate_indirect_keeping, , )
KINORA_INDIRECT(integrate_indirect_of_keeping, shader which;, which->)
#undef KINORA_INDIRECT

color integrate_indirect(color hints; float maxdist; uniform float counted;) {
    __radiancesample samples[];
    return integrate_indirect_keeping(hints, maxdist, counted, samples);
}
color integrate_indirect_of(shader which; color hints; float maxdist; uniform float counted;) {
    __radiancesample samples[];
    return integrate_indirect_of_keeping(which, hints, maxdist, counted, samples);
}

#endif
