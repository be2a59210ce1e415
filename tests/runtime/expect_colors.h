// tests/runtime/expect_colors.h: pictures against functions of the place in the plane z = 0.
#pragma once

#include <gtest/gtest.h>

#include "scene_text.h"

namespace kinora {

// The pixels that a surface covers, those of one sample at its centre; returns how many.
template <class F>
int expect_covered_colors(const Rendering& r, F&& expected, double tolerance = 2e-6) {
    EXPECT_FALSE(r.diagnostics.has_errors()) << r.findings();
    int covered = 0;
    for (int y = 0; y < r.film.height; ++y)
        for (int x = 0; x < r.film.width; ++x) {
            if (r.film.at(x, y).w == 0) continue;
            ++covered;
            dvec3 want = expected(r.place(x, y));
            vec3 got = r.color(x, y);
            for (int k = 0; k < 3; ++k) {
                EXPECT_NEAR(got[k], want[k], tolerance)
                    << "pixel " << x << "," << y << " component " << k << "\n"
                    << r.findings();
                if (testing::Test::HasFailure()) return covered;
            }
        }
    EXPECT_GT(covered, 0);
    return covered;
}

// All pixels, of which the surface must cover each.
template <class F>
void expect_colors(const Rendering& r, F&& expected, double tolerance = 2e-6) {
    int covered = expect_covered_colors(r, expected, tolerance);
    if (!testing::Test::HasFailure()) {
        EXPECT_EQ(covered, r.film.width * r.film.height);
    }
}

}  // namespace kinora
