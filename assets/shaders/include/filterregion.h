// filterregion.h: RSL 2.0's filterregion, the part of a texture that a pixel covers. A source that
// names the type has it without an #include.
#ifndef KINORA_FILTERREGION_H
#define KINORA_FILTERREGION_H

#include <stdrsl/radiancesample.h>

struct filterregion {
    varying float ss = 0;  // the middle
    varying float tt = 0;
    varying vector across = 0;  // one pixel to the right and down, in s and t
    varying vector along = 0;
    varying point centre = 0;  // of calculate3d()
    varying float radius = 0;

    void calculate2d(float x; float y) {
        ss = x;
        tt = y;
        across = vector "current" (Du(x) * du, Du(y) * du, 0);
        along = vector "current" (Dv(x) * dv, Dv(y) * dv, 0);
    }
    void calculate2d(float x; float y; float xu; float yu; float xv; float yv) {
        ss = x;
        tt = y;
        across = vector "current" (xu, yu, 0);
        along = vector "current" (xv, yv, 0);
    }
    void calculate3d(point p) {
        centre = p;
        radius = 0.5 * (length(Du(p) * du) + length(Dv(p) * dv));
    }
    void calculate3d(point p; vector pu; vector pv) {
        centre = p;
        radius = 0.5 * (length(pu) + length(pv));
    }
    void scale(float factor) {
        across *= factor;
        along *= factor;
        radius *= factor;
    }
    void scale(float by_s; float by_t) {
        across = vector "current" (across[0] * by_s, across[1] * by_t, 0);
        along = vector "current" (along[0] * by_s, along[1] * by_t, 0);
        radius *= max(by_s, by_t);
    }
    // By a part of the whole map, in both directions.
    void blur(float amount) {
        across += vector "current" (amount, 0, 0);
        along += vector "current" (0, amount, 0);
        radius += 0.5 * amount;
    }
    void blur(float by_s; float by_t) {
        across += vector "current" (by_s, 0, 0);
        along += vector "current" (0, by_t, 0);
        radius += 0.5 * max(by_s, by_t);
    }
};

#define KINORA_REGION_CORNER(k, x, y) (r->k - 0.5 * (x) - 0.5 * (y))
#define KINORA_REGION(type)                                                                       \
    type texture(uniform string file; filterregion r) {                                           \
        float au = r->across[0], av = r->across[1], bu = r->along[0], bv = r->along[1];           \
        return type texture(file, KINORA_REGION_CORNER(ss, au, bu), KINORA_REGION_CORNER(tt, av, bv), \
                            KINORA_REGION_CORNER(ss, -au, bu), KINORA_REGION_CORNER(tt, -av, bv), \
                            KINORA_REGION_CORNER(ss, au, -bu), KINORA_REGION_CORNER(tt, av, -bv), \
                            KINORA_REGION_CORNER(ss, -au, -bu),                                   \
                            KINORA_REGION_CORNER(tt, -av, -bv));                                  \
    }
KINORA_REGION(float)
KINORA_REGION(color)

// In the direction that calculate3d() has, over the angle of its radius.
#define KINORA_REGION_OF_SKY(type)                                                     \
    type environment(uniform string file; filterregion r) {                            \
        vector w = vector(r->centre);                                                  \
        return type environment(file, w, "blur", atan(r->radius, length(w)) / PI);     \
    }
KINORA_REGION_OF_SKY(float)
KINORA_REGION_OF_SKY(color)

#define KINORA_REGION_OF_FACE(type)                                                    \
    type ptexture(uniform string file; float channel; float face; filterregion r) {    \
        return type ptexture(file, channel, face);                                     \
    }
KINORA_REGION_OF_FACE(float)
KINORA_REGION_OF_FACE(color)

// Samples of a light lose what lies before it, by rays: maps are not read. Of the pairs "bias" has
// an effect.
void areashadow(string map; filterregion r; output __radiancesample samples[];
                string name1 = ""; float value1 = 0; string name2 = ""; float value2 = 0;
                string name3 = ""; float value3 = 0; string name4 = ""; float value4 = 0;
                string name5 = ""; float value5 = 0; string name6 = ""; float value6 = 0;) {
    float bias = -1, i;
    if (name1 == "bias") bias = value1;
    if (name2 == "bias") bias = value2;
    if (name3 == "bias") bias = value3;
    if (name4 == "bias") bias = value4;
    if (name5 == "bias") bias = value5;
    if (name6 == "bias") bias = value6;
    for (i = 0; i < arraylength(samples); i += 1) {
        point end = Ps + samples[i]->direction * min(samples[i]->distance, 1e6);
        samples[i]->radiance *= transmission(Ps, end, "bias", bias);
    }
}

#endif
