// filterwidth.h: how much a value changes over one sample of the picture.
#ifndef FILTERWIDTH_H
#define FILTERWIDTH_H

#define MINFILTWIDTH 1e-6  // keeps divisions by a width sane

// Width of a float that depends on the surface position.
#define filterwidth(x) max(abs(Du(x) * du) + abs(Dv(x) * dv), MINFILTWIDTH)
// Width of a point: the side of the square that one sample covers.
#define filterwidthp(p) max(sqrt(area(p)), MINFILTWIDTH)

#endif
