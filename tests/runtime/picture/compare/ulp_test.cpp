// tests/runtime/picture/compare/ulp_test.cpp: floats counted by hand.
#include "runtime/picture/compare/ulp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace kinora {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

TEST(Ulps, CountTheFloatsBetween) {
    EXPECT_EQ(ulps_between(1, 1), 0);
    EXPECT_EQ(ulps_between(1, std::nextafter(1.0f, 2.0f)), 1);
    EXPECT_EQ(ulps_between(1, 2), double(1 << 23));  // 23 bits of fraction
    EXPECT_EQ(ulps_between(0.0f, -0.0f), 0);
    float least = std::numeric_limits<float>::denorm_min();
    EXPECT_EQ(ulps_between(-least, least), 2);
    EXPECT_EQ(ulps_between(NAN, NAN), 0);
    EXPECT_EQ(ulps_between(NAN, 1), std::numeric_limits<double>::infinity());
}

TEST(Ulps, AreAsLongAsTheFloatsAroundStandApart) {
    EXPECT_EQ(ulp_of(1), 0x1p-23);
    EXPECT_EQ(ulp_of(1.999), 0x1p-23);
    EXPECT_EQ(ulp_of(-2), 0x1p-22);
    EXPECT_EQ(ulp_of(0), 0x1p-149);
    EXPECT_EQ(ulp_of(0x1p-140), 0x1p-149);
}

// Errors of 0, 1/4, 1, 3 and 1000 ULP of 1.
TEST(FloatErrors, AreCountedInBins) {
    FloatErrors errors;
    errors.add(1, 1);
    errors.add(1, 1 + 0x1p-25);
    errors.add(1, 1 + 0x1p-23);
    errors.add(1 + 0x1.8p-22f, 1);
    errors.add(1 + 1000 * 0x1p-23f, 1);
    EXPECT_EQ(errors.count(), 5u);
    EXPECT_EQ(errors.max(), 1000);
    EXPECT_DOUBLE_EQ(errors.mean(), (0.25 + 1 + 3 + 1000) / 5);
    const std::array<size_t, 8> bins = {1, 1, 1, 0, 1, 0, 0, 1};  // 0, .5, 1, 2, 4, 16, 256, more
    EXPECT_EQ(errors.histogram(), bins);
    EXPECT_EQ(errors.special(), 0u);
}

TEST(FloatErrors, CountApartWhatIsNoNumber) {
    FloatErrors errors;
    errors.add(NAN, NAN);
    errors.add(kInfinity, 1e300);  // past the largest float: infinite as a float
    EXPECT_EQ(errors.special(), 0u);
    errors.add(NAN, 1);
    errors.add(1, NAN);
    errors.add(-kInfinity, INFINITY);
    errors.add(kInfinity, 1);
    EXPECT_EQ(errors.special(), 4u);
    EXPECT_EQ(errors.count(), 0u);
    EXPECT_EQ(errors.mean(), 0);
}

}  // namespace
}  // namespace kinora
