// tests/skin/dual_quaternion_test.cpp: dual quaternion skinning against GLM's dual quaternions, and
// what it is for.
#define GLM_ENABLE_EXPERIMENTAL
#include "skin/dual_quaternion.h"

#include <gtest/gtest.h>

#include <cstring>
#include <glm/gtc/quaternion.hpp>
#include <glm/gtx/dual_quaternion.hpp>
#include <glm/matrix.hpp>

#include "character.h"
#include "runtime/base/parallel.h"
#include "wrung.h"

namespace kinora::skin {
namespace {

Skinned dual(const Character& c) {
    SkinMesh skin = build_skin(c.source(), c.normal_positions);
    std::vector<DualJoint> palette;
    for (const JointMatrix& m : c.palette()) palette.push_back(dual_joint(m));
    Skinned out{std::vector<vec4>(c.rest.size()), std::vector<vec4>(c.normals.size())};
    deform_dual(skin, palette, padded_floats(c.rest), padded_floats(c.normals), out.positions,
                out.normals);
    return out;
}

// Rigid joints alone: GLM's dual quaternions, in double.
std::vector<dvec3> by_glm(const Character& c) {
    std::vector<dvec3> out;
    auto of = [](const dmat4& m) {
        return glm::tdualquat<double>(glm::normalize(glm::quat_cast(dmat3(m))), dvec3(m[3]));
    };
    for (size_t v = 0; v < c.rest.size(); ++v) {
        double total = 0;
        glm::tdualquat<double> first, sum(glm::dquat(0, 0, 0, 0), glm::dquat(0, 0, 0, 0));
        for (size_t i = c.first[v]; i < c.first[v + 1]; ++i) total += c.weights[i];
        for (size_t i = c.first[v]; i < c.first[v + 1]; ++i) {
            auto q = of(c.joints[i] < 0 ? c.bind : c.matrices[size_t(c.joints[i])]);
            if (i == c.first[v]) first = q;
            const double w = c.weights[i] / total * (glm::dot(first.real, q.real) < 0 ? -1 : 1);
            sum = sum + q * w;
        }
        out.push_back(glm::normalize(sum) * c.rest[v]);
    }
    return out;
}

TEST(DualQuaternion, AgreesWithGlm) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        Character c = random_character(533, 9, 7, seed);
        EXPECT_LT(worst_difference(dual(c).positions, by_glm(c)), 1e-5) << seed;
    }
}

TEST(DualQuaternion, OneJointMovesAsItsMatrixDoes) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    Character c;
    auto any = [&] {
        dmat4 m(1.0);
        for (int column = 0; column < 4; ++column)
            m[column] = dvec4(normal(random), normal(random), normal(random), column == 3);
        return m;
    };
    for (int j = 0; j < 40; ++j) c.matrices.push_back(any());  // shear, and half of them mirror
    c.matrices[3] = dmat4(1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 2, 3, 4, 1);  // flat
    c.matrices[4] = dmat4(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 3, 4, 1);  // a point
    for (int j = 0; j < 40; ++j) {
        c.add_vertex(dvec3(vec3(normal(random), normal(random), normal(random))), {{j, 1}});
        c.add_normal(dvec3(vec3(normal(random), normal(random), normal(random))), uint32_t(j));
    }
    Skinned got = dual(c), linear = skin_it("portable", c);
    for (size_t v = 0; v < got.positions.size(); ++v)
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(got.positions[v][k], linear.positions[v][k], 2e-5) << v;
            EXPECT_NEAR(got.normals[v][k], linear.normals[v][k], 2e-4) << v;
        }
}

TEST(DualQuaternion, NormalsTurnWithTheSurface) {
    Character c = random_character(300, 5, 4, 8);
    Skinned got = dual(c);
    // Of rigid joints the blend is rigid: normals keep their angle to an edge of the rest shape.
    Character moved = c;
    for (size_t v = 0; v < c.rest.size(); ++v) moved.rest[v] += c.normals[v];
    Skinned ends = dual(moved);
    for (size_t v = 0; v < c.rest.size(); ++v) {
        dvec3 edge = dvec3(ends.positions[v]) - dvec3(got.positions[v]);
        dvec3 unit = edge / std::sqrt(glm::dot(edge, edge));
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(got.normals[v][k], unit[k], 1e-4) << v;
    }
}

TEST(DualQuaternion, ATwistOfTwoTurnsKeepsItsVolume) {
    for (double degrees : {30.0, 90.0, 150.0, 179.0}) {  // a step; 90 is 720 over nine joints
        Skinned s = dual(wrung(9, radians(degrees), 16));
        for (size_t v = 0; v < s.positions.size(); ++v) {
            const double radius = std::hypot(double(s.positions[v].y), double(s.positions[v].z));
            ASSERT_NEAR(radius, 1, 1e-5) << degrees << " degrees";
            ASSERT_NEAR(s.positions[v].x, double(v) / 16, 1e-5);
        }
    }
}

// Between two joints half a turn apart the limb goes the positive way about its axis.
TEST(DualQuaternion, HalfATurnTakesThePositiveSide) {
    for (double degrees : {180.0, -180.0, 179.99, 540.0}) {
        Skinned s = dual(wrung(2, radians(degrees), 16));
        const vec4 middle = s.positions[8];  // of equal weights: a quarter turn
        EXPECT_NEAR(middle.y, 0, 1e-3) << degrees;
        EXPECT_NEAR(middle.z, 1, 1e-3) << degrees;
    }
}

// On the way to half a turn no vertex moves faster than the joint does, and what joint matrices
// lack to half a turn by rounding is half a turn too.
TEST(DualQuaternion, IsContinuousInTimeUpToHalfATurn) {
    constexpr int kBetween = 16;
    auto at = [](double degrees) { return dual(wrung(2, radians(degrees), kBetween)).positions; };
    std::vector<vec4> before = at(-179);
    for (int degrees = -178; degrees <= 180; ++degrees) {
        const std::vector<vec4> now = at(degrees);
        for (size_t v = 0; v < now.size(); ++v) {
            // By hand: two unit quaternions half the angle apart, mixed by 1 - w and w.
            const double w = double(v) / kBetween, half = radians(double(degrees)) / 2;
            const double turn = 2 * std::atan2(w * std::sin(half), 1 - w + w * std::cos(half));
            ASSERT_NEAR(now[v].y, std::cos(turn), 1e-5) << degrees << " " << v;
            ASSERT_NEAR(now[v].z, std::sin(turn), 1e-5) << degrees << " " << v;
            ASSERT_LE(glm::distance(now[v], before[v]), radians(1.0) + 1e-5) << degrees << " " << v;
        }
        before = now;
    }
    for (double off : {1e-5, -1e-5}) {
        const std::vector<vec4> near = at(180 + off);
        for (size_t v = 0; v < near.size(); ++v)
            EXPECT_LE(glm::distance(near[v], before[v]), 1e-5) << off << " " << v;
    }
}

// Joints of all kinds, half turns, weights of 0 and below, and a last block that is not whole.
TEST(DualQuaternion, AllKernelsGiveTheSameBits) {
    for (uint32_t influences : {1u, 3u, 4u, 9u}) {
        Character c = random_character(1003, 12, influences, 7 + influences);
        c.matrices[1] = dmat4(1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 2, 3, 4, 1);    // flat
        c.matrices[2] = dmat4(-1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 0, 0, 1);   // mirrors
        c.matrices[3] = dmat4(-1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1);  // half a turn
        c.matrices[4] = dmat4(1);
        c.matrices[5] = dmat4(1e20, 0, 0, 0, 0, 1e20, 0, 0, 0, 0, 1e20, 0, 0, 0, 0, 1);
        SkinMesh skin = build_skin(c.source(), c.normal_positions);
        std::vector<DualJoint> palette;
        for (const JointMatrix& m : c.palette()) palette.push_back(dual_joint(m));
        auto by = [&](const char* kernel) {
            Skinned out{std::vector<vec4>(c.rest.size()), std::vector<vec4>(c.normals.size())};
            deform_dual_with(kernel, skin, palette, padded_floats(c.rest), padded_floats(c.normals),
                             out.positions, out.normals);
            return out;
        };
        Skinned portable = by("portable");
        for (const char* kernel : deform_kernels()) {
            Skinned other = by(kernel);
            EXPECT_EQ(std::memcmp(portable.positions.data(), other.positions.data(),
                                  portable.positions.size() * 16),
                      0)
                << kernel;
            EXPECT_EQ(std::memcmp(portable.normals.data(), other.normals.data(),
                                  portable.normals.size() * 16),
                      0)
                << kernel;
        }
    }
}

TEST(DualQuaternion, ThreadsGiveTheSameBits) {
    Character c = random_character(20000, 12, 5, 4);
    Skinned one, two;
    const int before = thread_count();
    set_thread_count(1);
    one = dual(c);
    set_thread_count(2);
    two = dual(c);
    set_thread_count(before);
    EXPECT_EQ(std::memcmp(one.positions.data(), two.positions.data(), one.positions.size() * 16),
              0);
    EXPECT_EQ(std::memcmp(one.normals.data(), two.normals.data(), one.normals.size() * 16), 0);
}

}  // namespace
}  // namespace kinora::skin
