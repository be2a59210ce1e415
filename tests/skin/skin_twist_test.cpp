// tests/skin/skin_twist_test.cpp: what linear blending does to a limb that is wrung.
#include <gtest/gtest.h>

#include "character.h"

namespace kinora::skin {
namespace {

// A limb along x: joint j at x = j, turned about x by j steps of `step` radians. Vertices at radius
// 1 between the joints, each with its share of the next joint's weight.
Character wrung(int joints, double step, int between) {
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

// Two unit vectors an angle apart, mixed by 1 - w and w.
double mixed_length(double w, double angle) {
    return std::sqrt((1 - w) * (1 - w) + w * w + 2 * w * (1 - w) * std::cos(angle));
}

TEST(SkinTwist, LinearBlendingLosesWhatItsFormulaSays) {
    constexpr int kBetween = 16;
    for (double degrees : {30.0, 90.0, 150.0, 180.0}) {  // a step: 90 is 720 over nine joints
        const double step = radians(degrees);
        Skinned s = skin_it(deform_kernels()[0], wrung(9, step, kBetween));
        double least = 1;
        for (size_t v = 0; v < s.positions.size(); ++v) {
            const double w = double(v % kBetween) / kBetween;
            const double radius = std::hypot(double(s.positions[v].y), double(s.positions[v].z));
            EXPECT_NEAR(radius, mixed_length(w, step), 1e-6) << degrees << " degrees";
            EXPECT_NEAR(s.positions[v].x, double(v) / kBetween, 1e-6);
            least = std::min(least, radius);
        }
        EXPECT_NEAR(least, std::abs(std::cos(step / 2)), 1e-6);
    }
}

}  // namespace
}  // namespace kinora::skin
