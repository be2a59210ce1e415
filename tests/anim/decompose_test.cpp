// tests/anim/decompose_test.cpp: matrices taken apart and put together (docs/numerics.md#keys).
#include "anim/decompose.h"

#include <gtest/gtest.h>
#include <glm/gtc/quaternion.hpp>
#include <glm/matrix.hpp>

#include <cmath>
#include <random>

#include "anim/sampler.h"

namespace kinora::anim {
namespace {

dmat3 linear(const Matrix16& m) {
    dmat3 a;
    for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c) a[c][r] = m[r * 4 + c];
    return a;
}

Matrix16 rotation_x(double degrees, double tx = 0) {
    double c = std::cos(radians(degrees)), s = std::sin(radians(degrees));
    return {1, 0, 0, tx, 0, c, -s, 0, 0, s, c, 0, 0, 0, 0, 1};
}

double difference(const Matrix16& a, const Matrix16& b) {
    double worst = 0;
    for (int i = 0; i < 16; ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

TEST(Decompose, ComposingGivesTheMatrixBack) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    for (int n = 0; n < 2000; ++n) {
        Matrix16 m;
        for (double& v : m) v = normal(random);
        ASSERT_LT(difference(compose(decompose(m)), m), 1e-13);
    }
}

TEST(Decompose, RotationIsProperAndStretchSymmetric) {
    std::mt19937 random(2);
    std::normal_distribution<double> normal;
    for (int n = 0; n < 2000; ++n) {
        Matrix16 m;
        for (double& v : m) v = normal(random);
        RigidStretch r = decompose(m);
        ASSERT_NEAR(glm::determinant(rotation_from_quaternion(r.rotation)), 1, 1e-14);
        dmat3 skew = r.stretch - glm::transpose(r.stretch);
        for (int c = 0; c < 3; ++c)
            for (int k = 0; k < 3; ++k) ASSERT_NEAR(skew[c][k], 0, 1e-13);
        // same sign as the matrix: a mirror stays in the stretch
        ASSERT_GT(glm::determinant(linear(m)) * glm::determinant(r.stretch), 0);
    }
}

TEST(Decompose, SingularMatricesAndExtremeScalesComeBack) {
    const Matrix16 cases[] = {
        {},
        {1, 0, 0, 5, 0, 1, 0, 6, 0, 0, 0, 7, 0, 0, 0, 1},
        {0, 0, 3, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1},
        {1, 1, 1, 0, 1, 1, 1, 0, 1, 1, 1, 0, 0, 0, 0, 1},
        {1e-200, 0, 0, 0, 0, 1e-200, 0, 0, 0, 0, 1e-200, 0, 0, 0, 0, 1},
        {1e200, 0, 0, 0, 0, 0, 1e200, 0, 0, 1e200, 0, 0, 0, 0, 0, 1},
        {-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1},
    };
    for (const Matrix16& m : cases) {
        double largest = 0;
        for (double v : m) largest = std::max(largest, std::abs(v));
        EXPECT_LE(difference(compose(decompose(m)), m), 1e-14 * largest);
    }
}

TEST(Decompose, ShearSurvivesBetweenKeys) {
    Matrix16 shear{1, 0.5, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    RigidStretch r = decompose(shear);
    EXPECT_LT(difference(compose(interpolate(r, r, 0.37)), shear), 1e-14);
}

TEST(Slerp, NegatedQuaternionIsTheSameRotation) {
    Quaternion a{1, 0, 0, 0}, b{std::cos(0.3), 0, std::sin(0.3), 0};
    Quaternion p = slerp(a, b, 0.25), q = slerp(a, {-b.w, -b.x, -b.y, -b.z}, 0.25);
    EXPECT_NEAR(p.w, std::cos(0.075), 1e-15);
    EXPECT_NEAR(p.y, std::sin(0.075), 1e-15);
    EXPECT_EQ(p.w, q.w);
    EXPECT_EQ(p.y, q.y);
}

TEST(Slerp, AgreesWithGlm) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int n = 0; n < 1000; ++n) {
        Quaternion a = normalized({normal(random), normal(random), normal(random), normal(random)});
        Quaternion b = normalized({normal(random), normal(random), normal(random), normal(random)});
        double s = 0.001 * n;
        auto expected =
            glm::slerp(glm::dquat(a.w, a.x, a.y, a.z), glm::dquat(b.w, b.x, b.y, b.z), s);
        Quaternion q = slerp(a, b, s);
        double dot = q.w * expected.w + q.x * expected.x + q.y * expected.y + q.z * expected.z;
        ASSERT_NEAR(std::abs(dot), 1, 1e-12);
    }
}

TEST(Slerp, HalfTurnsFollowTheAxisThatCountsAsPositive) {
    // both ways are equally long; the rule picks the same one for b and -b and for noise around it
    for (double sign : {1.0, -1.0})
        for (double noise : {0.0, 1e-14, -1e-14}) {
            Quaternion q = slerp({1, 0, 0, 0}, {noise, 0, sign, 0}, 0.5);
            EXPECT_NEAR(q.w, std::sqrt(0.5), 1e-12);
            EXPECT_NEAR(q.y, std::sqrt(0.5), 1e-12);
        }
}

TEST(Slerp, ZeroQuaternionIsTheIdentity) {
    Quaternion q = slerp({0, 0, 0, 0}, {0, 0, 0, 0}, 0.5);
    EXPECT_EQ(q.w, 1);
    EXPECT_EQ(normalized({NAN, 0, 0, 0}).w, 1);
}

TEST(MatrixSampler, LinearKeysAHalfTurnApartKeepTheDeterminant) {
    for (double degrees : {5.0, 90.0, 179.0, 180.0, 181.0}) {
        Matrix16 a = rotation_x(0), b = rotation_x(degrees, 10);
        std::vector<double> times{0, 1}, values(a.begin(), a.end());
        values.insert(values.end(), b.begin(), b.end());
        SamplerSource source{times, values, 16};
        source.kind = SampleKind::Matrix;
        Sampler s = make_sampler(source);
        for (double t = 0; t <= 1; t += 1.0 / 64) {
            Matrix16 m;
            evaluate(s, t, 0, m);
            ASSERT_NEAR(glm::determinant(linear(m)), 1, 1e-6);
            ASSERT_NEAR(m[3], 10 * t, 1e-12);
        }
        Matrix16 half;
        evaluate(s, 0.5, 0, half);
        double turn = degrees > 180 ? degrees - 360 : degrees;
        EXPECT_LT(difference(half, rotation_x(turn / 2, 5)), 1e-12) << degrees;
    }
}

TEST(MatrixSampler, KeysGiveTheDocumentsOwnNumbers) {
    std::mt19937 random(4);
    std::normal_distribution<double> normal;
    std::vector<double> times{0, 1, 2}, values;
    for (int i = 0; i < 48; ++i) values.push_back(normal(random));
    SamplerSource source{times, values, 16};
    source.kind = SampleKind::Matrix;
    Sampler s = make_sampler(source);
    for (size_t k = 0; k < 3; ++k) {
        Matrix16 m;
        evaluate(s, times[k], 0, m);
        for (size_t i = 0; i < 16; ++i) EXPECT_EQ(m[i], values[k * 16 + i]);
    }
}

TEST(MatrixSampler, OtherInterpolationsWorkOnTheNumbers) {
    Matrix16 a = rotation_x(0), b = rotation_x(90);
    std::vector<double> times{0, 1}, values(a.begin(), a.end());
    values.insert(values.end(), b.begin(), b.end());
    std::vector<Interpolation> cardinal{Interpolation::Cardinal};
    SamplerSource source{times, values, 16, cardinal};
    source.kind = SampleKind::Matrix;
    Matrix16 m;
    evaluate(make_sampler(source), 0.5, 0, m);
    EXPECT_NEAR(m[5], 0.5, 1e-15);
}

TEST(MatrixSampler, ElementsAreReadAloneToo) {
    Matrix16 a = rotation_x(0), b = rotation_x(90, 8);
    std::vector<double> times{0, 1}, values(a.begin(), a.end());
    values.insert(values.end(), b.begin(), b.end());
    SamplerSource source{times, values, 16};
    source.kind = SampleKind::Matrix;
    double one = 0;
    evaluate(make_sampler(source), 0.5, 5, std::span(&one, 1));
    EXPECT_NEAR(one, std::cos(radians(45)), 1e-14);
}

}  // namespace
}  // namespace kinora::anim
