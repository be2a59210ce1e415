// tests/skin/morph_test.cpp: both morph methods against their formulas, and skin on morph.
#include "skin/morph.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "allocation_count.h"
#include "character.h"
#include "runtime/base/parallel.h"

namespace kinora::skin {
namespace {

struct Shapes {
    std::vector<vec3> base, normals;
    std::vector<std::vector<vec3>> targets, target_normals;
    std::vector<MorphTargetSource> sources() const {
        std::vector<MorphTargetSource> out;
        for (size_t t = 0; t < targets.size(); ++t) out.push_back({targets[t], target_normals[t]});
        return out;
    }
};

// Target 0 moves all vertices, target 1 every tenth, target 2 none.
Shapes random_shapes(size_t vertices, MorphMethod method) {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    auto vector = [&] { return vec3(normal(random), normal(random), normal(random)); };
    Shapes s;
    s.targets.resize(3), s.target_normals.resize(3);
    for (size_t v = 0; v < vertices; ++v) {
        s.base.push_back(vector());
        s.normals.push_back(vector());
        for (size_t t = 0; t < 3; ++t) {
            bool moves = t == 0 || (t == 1 && v % 10 == 0);
            bool whole = method == MorphMethod::Normalized;
            vec3 still(0.0f);
            s.targets[t].push_back((whole ? s.base[v] : still) + (moves ? vector() : still));
            s.target_normals[t].push_back((whole ? s.normals[v] : still) +
                                          (moves ? vector() : still));
        }
    }
    return s;
}

std::vector<dvec3> doubles(const std::vector<vec3>& from) {
    return {from.begin(), from.end()};
}

struct Morphed {
    std::vector<vec4> positions, normals;
};
Morphed morph_it(const Morph& morph, const std::vector<double>& weights) {
    Morphed out{std::vector<vec4>(morph.base_positions.size(), vec4(NAN)),
                std::vector<vec4>(morph.base_normals.size(), vec4(NAN))};
    deform(morph, weights, out.positions, out.normals);
    return out;
}

class Method : public testing::TestWithParam<MorphMethod> {};
INSTANTIATE_TEST_SUITE_P(Both, Method,
                         testing::Values(MorphMethod::Normalized, MorphMethod::Relative));

TEST_P(Method, AgreesWithItsFormula) {
    Shapes s = random_shapes(5000, GetParam());
    Morph morph = build_morph(GetParam(), s.base, s.normals, s.sources());
    std::vector<double> weights{0.3, -0.7, 0.2};
    std::vector<std::vector<dvec3>> targets;
    for (auto& t : s.targets) targets.push_back(doubles(t));
    EXPECT_LT(worst_difference(morph_it(morph, weights).positions,
                               reference::morph(GetParam(), doubles(s.base), targets, weights)),
              1e-6 * 8);
}

TEST_P(Method, NormalsAreBlendedAndMadeUnit) {
    Shapes s = random_shapes(300, GetParam());
    Morph morph = build_morph(GetParam(), s.base, s.normals, s.sources());
    std::vector<double> weights{0.4, 0.1, 0};
    std::vector<std::vector<dvec3>> targets;
    for (auto& t : s.target_normals) targets.push_back(doubles(t));
    auto expected = reference::morph(GetParam(), doubles(s.normals), targets, weights);
    for (dvec3& n : expected) n /= std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    EXPECT_LT(worst_difference(morph_it(morph, weights).normals, expected), 1e-5);
}

TEST_P(Method, ZeroWeightsGiveTheBaseExactly) {
    Shapes s = random_shapes(100, GetParam());
    Morph morph = build_morph(GetParam(), s.base, s.normals, s.sources());
    for (auto& weights : std::vector<std::vector<double>>{{0, 0, 0}, {}, {NAN, 0}}) {
        Morphed out = morph_it(morph, weights);
        for (size_t i = 0; i < 100; ++i) EXPECT_EQ(vec3(out.positions[i]), s.base[i]);
    }
}

TEST(Morph, FullWeightNormalizedIsTheTarget) {
    Shapes s = random_shapes(100, MorphMethod::Normalized);
    Morph morph = build_morph(MorphMethod::Normalized, s.base, s.normals, s.sources());
    EXPECT_LT(worst_difference(morph_it(morph, {1, 0, 0}).positions, doubles(s.targets[0])), 1e-6);
}

TEST(Morph, TargetsThatMoveLittleAreKeptSparse) {
    Shapes s = random_shapes(100, MorphMethod::Relative);
    Morph morph = build_morph(MorphMethod::Relative, s.base, s.normals, s.sources());
    EXPECT_EQ(morph.targets[0].positions.deltas.size(), 100u);
    EXPECT_EQ(morph.targets[1].positions.deltas.size(), 10u);
    EXPECT_EQ(morph.targets[2].positions.deltas.size(), 0u);
}

TEST(Morph, TargetsOfAnotherCountAreUsedAsFarAsBothReach) {
    std::vector<vec3> base(4, vec3(1)), shorter(2, vec3(1)), longer(9, vec3(1));
    std::vector<MorphTargetSource> targets{{shorter}, {longer}};
    uint32_t mismatched = 0;
    Morph morph = build_morph(MorphMethod::Relative, base, {}, targets, &mismatched);
    EXPECT_EQ(mismatched, 2u);
    Morphed out = morph_it(morph, {1, 1, 5, 5});
    EXPECT_EQ(out.positions[1], vec4(3, 3, 3, 0));
    EXPECT_EQ(out.positions[3], vec4(2, 2, 2, 0));
}

TEST(Morph, ThreadsGiveTheSameBitsAndNothingIsAllocated) {
    Shapes s = random_shapes(20000, MorphMethod::Relative);
    Morph morph = build_morph(MorphMethod::Relative, s.base, s.normals, s.sources());
    std::vector<double> weights{0.3, 0.2, 0.1};
    set_thread_count(2);
    Morphed two = morph_it(morph, weights);
    set_thread_count(1);
    Morphed one = morph_it(morph, weights);
    EXPECT_EQ(std::memcmp(one.positions.data(), two.positions.data(), 16 * 20000), 0);
    EXPECT_EQ(std::memcmp(one.normals.data(), two.normals.data(), 16 * 20000), 0);
    size_t before = allocation_count();
    for (int i = 0; i < 10; ++i) deform(morph, weights, one.positions, one.normals);
    EXPECT_EQ(allocation_count(), before);
}

TEST(Morph, SkinOnMorphTakesTheMorphsBuffers) {
    Shapes s = random_shapes(50, MorphMethod::Relative);
    Morph morph = build_morph(MorphMethod::Relative, s.base, s.normals, s.sources());
    std::vector<double> weights{0.5, 0.5, 0};
    Morphed rest = morph_it(morph, weights);
    Character c = random_character(50, 5, 3, 8);
    std::vector<vec4> positions(50), normals(50);
    deform(build_skin(c.source(), c.normal_positions), c.palette(), rest.positions, rest.normals,
           positions, normals);
    std::vector<std::vector<dvec3>> targets;
    for (auto& t : s.targets) targets.push_back(doubles(t));
    auto morphed = reference::morph(MorphMethod::Relative, doubles(s.base), targets, weights);
    EXPECT_LT(worst_difference(positions,
                               reference::skin_positions(c.source(), c.matrices, c.bind, morphed)),
              1e-5);
}

}  // namespace
}  // namespace kinora::skin
