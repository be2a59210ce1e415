// tests/skin/wrung.h: a limb that is twisted about its own axis.
#pragma once

#include "character.h"

namespace kinora::skin {

// A limb along x: joint j at x = j, turned about x by j steps of `step` radians. Vertices at radius
// 1 between the joints, each with its share of the next joint's weight.
inline Character wrung(int joints, double step, int between) {
    Character c;
    for (int j = 0; j < joints; ++j) {
        const double a = j * step;
        c.matrices.push_back({dvec4(1, 0, 0, 0), dvec4(0, std::cos(a), std::sin(a), 0),
                              dvec4(0, -std::sin(a), std::cos(a), 0), dvec4(0, 0, 0, 1)});
    }
    for (int j = 0; j + 1 < joints; ++j)
        for (int k = 0; k < between; ++k) {
            const double w = double(k) / between;
            c.add_vertex(dvec3(j + w, 1, 0), {{j, 1 - w}, {j + 1, w}});
        }
    return c;
}

}  // namespace kinora::skin
