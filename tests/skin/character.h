// tests/skin/character.h: random skinned meshes, kept in double beside the floats under test.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "skin/reference.h"

namespace kinora::skin {

inline dmat4 random_rigid(std::mt19937& random, double distance) {
    std::normal_distribution<double> normal;
    dvec3 x(normal(random), normal(random), normal(random)), y(normal(random), normal(random), 1);
    x /= std::sqrt(x.x * x.x + x.y * x.y + x.z * x.z);
    double d = x.x * y.x + x.y * y.y + x.z * y.z;
    y -= d * x;
    y /= std::sqrt(y.x * y.x + y.y * y.y + y.z * y.z);
    dvec3 z(x.y * y.z - x.z * y.y, x.z * y.x - x.x * y.z, x.x * y.y - x.y * y.x);
    dvec3 t(normal(random), normal(random), normal(random));
    return {dvec4(x, 0), dvec4(y, 0), dvec4(z, 0), dvec4(distance * t, 1)};
}

struct Character {
    std::vector<uint32_t> first{0};
    std::vector<int32_t> joints;
    std::vector<double> weights;
    std::vector<dvec3> rest, normals;
    std::vector<uint32_t> normal_positions;
    std::vector<dmat4> matrices;  // world_from_rest per joint
    dmat4 bind{1.0};

    uint32_t joint_count() const { return static_cast<uint32_t>(matrices.size()); }
    InfluenceSource source() const { return {first, joints, weights, joint_count()}; }
    void add_vertex(const dvec3& p, const std::vector<std::pair<int, double>>& influences) {
        rest.push_back(p);
        for (auto [joint, weight] : influences) {
            joints.push_back(joint);
            weights.push_back(weight);
        }
        first.push_back(static_cast<uint32_t>(joints.size()));
    }
    void add_normal(const dvec3& n, uint32_t position) {
        normals.push_back(n);
        normal_positions.push_back(position);
    }
    std::vector<JointMatrix> palette() const {
        std::vector<JointMatrix> out{joint_matrix(bind, {})};
        for (const dmat4& m : matrices) out.push_back(joint_matrix(m, {}));
        return out;
    }
};

// `vertices` with 1..most influences each, rigid joints about the origin, one normal a vertex.
inline Character random_character(size_t vertices, int joints, int most, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_int_distribution<int> joint(-1, joints - 1), count(1, most);
    Character c;
    for (int j = 0; j < joints; ++j) c.matrices.push_back(random_rigid(random, 0.3));
    c.bind = random_rigid(random, 0.1);
    for (size_t v = 0; v < vertices; ++v) {
        std::vector<std::pair<int, double>> influences;
        for (int n = count(random); n > 0; --n)
            influences.push_back({joint(random), 0.05 + std::abs(normal(random))});
        // floats exactly, so that reference and kernel start from the same numbers
        dvec3 p(vec3(normal(random), normal(random), normal(random)));
        c.add_vertex(p, influences);
        c.add_normal(dvec3(vec3(normal(random), normal(random), normal(random))), uint32_t(v));
    }
    return c;
}

struct Skinned {
    std::vector<vec4> positions, normals;
};

inline std::vector<vec4> padded_floats(const std::vector<dvec3>& from) {
    std::vector<vec4> to;
    for (const dvec3& v : from) to.push_back(vec4(vec3(v), 7.0f));  // w must not matter
    return to;
}

inline Skinned skin_it(const char* kernel, const Character& c, const SkinMesh& skin,
                       const std::vector<JointMatrix>& palette) {
    Skinned out{std::vector<vec4>(c.rest.size(), vec4(NAN)),
                std::vector<vec4>(c.normals.size(), vec4(NAN))};
    deform_with(kernel, skin, palette, padded_floats(c.rest), padded_floats(c.normals),
                out.positions, out.normals);
    return out;
}
inline Skinned skin_it(const char* kernel, const Character& c) {
    return skin_it(kernel, c, build_skin(c.source(), c.normal_positions), c.palette());
}

inline double worst_difference(const std::vector<vec4>& a, const std::vector<dvec3>& b) {
    double worst = 0;
    EXPECT_EQ(a.size(), b.size());
    for (size_t i = 0; i < b.size(); ++i) {
        EXPECT_EQ(a[i].w, 0);
        for (int k = 0; k < 3; ++k) {
            double difference = std::abs(a[i][k] - b[i][k]);
            worst = difference <= worst ? worst : difference;  // NaN counts as worst
        }
    }
    return worst;
}

}  // namespace kinora::skin
