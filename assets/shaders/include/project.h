// project.h: two-dimensional texture coordinates of points, by the usual projections.
#ifndef PROJECT_H
#define PROJECT_H

#include "filterwidth.h"

// Where a ray from the origin through p meets a unit sphere: longitude and latitude from 0 to 1.
void spherical_projection(point p; output float ss, tt;) {
    vector v = normalize(vector p);
    ss = atan(-ycomp(v), -xcomp(v)) / (2 * PI) + 0.5;
    tt = 1 - acos(clamp(zcomp(v), -1, 1)) / PI;
}

// The angle around z from 0 to 1, and the height.
void cylindrical_projection(point p; output float ss, tt;) {
    ss = atan(-ycomp(p), -xcomp(p)) / (2 * PI) + 0.5;
    tt = zcomp(p);
}

// ss, tt of p by "st", "planar", "perspective", "spherical", "cylindrical" or "box", after p has been
// brought to `whichspace` and transformed by xform; ds, dt are their widths over one sample.
void ProjectTo2D(string projection; point p; string whichspace; matrix xform; output float ss, tt;
                 output float ds, dt) {
    point q = transform(xform, transform(whichspace, p));
    if (projection == "st") {
        q = transform(xform, point(s, t, 0));
        ss = xcomp(q);
        tt = ycomp(q);
    } else if (projection == "perspective") {
        ss = xcomp(q) / max(zcomp(q), MINFILTWIDTH);
        tt = ycomp(q) / max(zcomp(q), MINFILTWIDTH);
    } else if (projection == "spherical") {
        spherical_projection(q, ss, tt);
    } else if (projection == "cylindrical") {
        cylindrical_projection(q, ss, tt);
    } else if (projection == "box") {
        normal n = ntransform(whichspace, Ng);
        float x = abs(xcomp(n)), y = abs(ycomp(n)), z = abs(zcomp(n));
        ss = x > y && x > z ? ycomp(q) : xcomp(q);
        tt = z > x && z > y ? ycomp(q) : zcomp(q);
    } else {  // "planar"
        ss = xcomp(q);
        tt = ycomp(q);
    }
    ds = filterwidth(ss);
    dt = filterwidth(tt);
    // Where an angle jumps from 1 to 0 the width is that of the jump: take it modulo 1.
    if (projection == "spherical" || projection == "cylindrical") ds = min(ds, abs(1 - ds));
}

#endif
