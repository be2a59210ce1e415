// filterregion.h: RSL 2.0's filterregion, the part of a texture that a pixel covers. A source that
// names the type has it without an #include.
#ifndef KINORA_FILTERREGION_H
#define KINORA_FILTERREGION_H

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
    // By a part of the whole map, in both directions.
    void blur(float amount) {
        across += vector "current" (amount, 0, 0);
        along += vector "current" (0, amount, 0);
        radius += 0.5 * amount;
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

#endif
