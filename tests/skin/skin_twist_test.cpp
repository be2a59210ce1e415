// tests/skin/skin_twist_test.cpp: what linear blending does to a limb that is wrung.
#include <gtest/gtest.h>

#include "character.h"
#include "skin/narrowest.h"
#include "wrung.h"

namespace kinora::skin {
namespace {

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

// What is told of a pose is what its vertices have lost, bends and stretches included.
TEST(SkinTwist, TheNarrowestPlaceIsToldOfAPose) {
    for (double degrees : {0.0, 30.0, 90.0, 150.0, 180.0}) {
        Character c = wrung(9, radians(degrees), 16);
        const SkinMesh skin = build_skin(c.source(), c.normal_positions);
        EXPECT_NEAR(narrowest(skin, c.palette()), std::abs(std::cos(radians(degrees) / 2)), 1e-6)
            << degrees;
        for (dmat4& m : c.matrices) m = m * dmat4(2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 1, 2, 3, 1);
        EXPECT_NEAR(narrowest(skin, c.palette()), std::abs(std::cos(radians(degrees) / 2)), 1e-6)
            << degrees << ", twice as large";
    }
}

}  // namespace
}  // namespace kinora::skin
